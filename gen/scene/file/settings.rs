//! The tables `[effects]` and `[parameters]` of a scene file.

use super::tables::SceneTable;
use super::Fault;
use crate::params::Params;
use crate::scene::settings::{Effect, Parameter, Settings, Switch};
use toml::{Spanned, Value};

/// The key of the share that may become possibly incorrect.
const ALLOWED: &str = "allowed";

/// The options that are a stage by another name: these and the effect must not both be given.
const STAGES: [(&str, Effect); 4] = [
    ("transform", Effect::Transform),
    ("renormalise", Effect::Renormalise),
    ("axes", Effect::InPlaneAxes),
    ("upper", Effect::ExactCeiling),
];

/// The settings of a file; `line` counts the lines up to a byte of it.
pub(super) fn of(scene: &SceneTable, line: impl Fn(usize) -> usize) -> Result<Settings, Fault> {
    let mut settings = Settings::default();
    for (key, value) in &scene.effects {
        if key.get_ref() == ALLOWED {
            settings.allowed = share(value)?;
        } else {
            settings.switches.set(effect(key)?, switch(value)?);
        }
    }
    let known = Params::default().options();
    for (key, value) in &scene.parameters {
        let name = key.get_ref();
        if !known.iter().any(|(option, _)| option == name) {
            let legal: Vec<&str> = known.iter().map(|(option, _)| *option).collect();
            return Err(Fault::at(key, format!("parameter '{name}': legal is one of {}", legal.join(", "))));
        }
        if let Some((_, effect)) = STAGES.iter().find(|(option, _)| option == name) {
            if settings.switches.get(*effect) != Switch::Auto {
                let message = format!("parameter '{name}' beside the effect '{effect}': legal is one of the two");
                return Err(Fault::at(key, message));
            }
        }
        let line = line(key.span().start);
        settings.parameters.push(Parameter { name: name.clone(), value: text(name, value)?, line });
    }
    Ok(settings)
}

fn effect(key: &Spanned<String>) -> Result<Effect, Fault> {
    Effect::ALL.into_iter().find(|effect| effect.name() == key.get_ref()).ok_or_else(|| {
        let legal = Effect::ALL.map(Effect::name).join(", ");
        Fault::at(key, format!("effect '{}': legal is one of {legal}, {ALLOWED}", key.get_ref()))
    })
}

fn switch(value: &Spanned<Value>) -> Result<Switch, Fault> {
    let known = Switch::ALL.into_iter().find(|switch| value.get_ref().as_str() == Some(switch.name()));
    known.ok_or_else(|| {
        let legal = Switch::ALL.map(|switch| format!("\"{}\"", switch.name())).join(", ");
        Fault::at(value, format!("{}: legal is one of {legal}", found(value)))
    })
}

fn share(value: &Spanned<Value>) -> Result<f64, Fault> {
    let number = match value.get_ref() {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    };
    let legal = |number: &f64| (0.0..=1.0).contains(number);
    number
        .filter(legal)
        .ok_or_else(|| Fault::at(value, format!("{ALLOWED} {}: legal is a number from 0 to 1", found(value))))
}

/// A value as it would be typed.
fn text(name: &str, value: &Spanned<Value>) -> Result<String, Fault> {
    match value.get_ref() {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(number) => Ok(number.to_string()),
        _ => {
            let message = format!("{name} {}: legal is a whole number or a word in quotes", found(value));
            Err(Fault::at(value, message))
        }
    }
}

/// What stands in the file, in a few words.
fn found(value: &Spanned<Value>) -> String {
    match value.get_ref() {
        Value::String(text) => format!("'{text}'"),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(flag) => flag.to_string(),
        other => format!("a value of type {}", other.type_str()),
    }
}
