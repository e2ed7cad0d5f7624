//! What a scene file says of the unit that is to serve it: the tables `[effects]` and `[parameters]`.

use crate::params::Params;
use efsat_geometry::scene::{Entry, Scene, SceneError, Value};
use std::fmt;
use std::path::Path;

/// The key of the share that may become possibly incorrect.
const ALLOWED: &str = "allowed";

/// The options that are a stage by another name: these and the effect must not both be given.
const STAGES: [(&str, Effect); 4] = [
    ("transform", Effect::Transform),
    ("renormalise", Effect::Renormalise),
    ("axes", Effect::InPlaneAxes),
    ("upper", Effect::ExactCeiling),
];

/// An optional stage of the unit or of the pipeline before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effect {
    /// Sort and sweep over the objects of a frame.
    BroadPhase,
    /// Trees of k-DOPs over the triangles of a mesh.
    Hierarchy,
    /// Pairs with a degenerate triangle are answered in software.
    Degenerate,
    /// The change of frame in the unit.
    Transform,
    /// Each pair moved to the origin and scaled up.
    Renormalise,
    /// The six in-plane axes.
    InPlaneAxes,
    /// Upper bounds by sticky bits.
    ExactCeiling,
}

impl Effect {
    /// All of them, in the order of the pipeline, which is the order in which they are tried.
    pub const ALL: [Self; 7] = [
        Self::BroadPhase,
        Self::Hierarchy,
        Self::Degenerate,
        Self::Transform,
        Self::Renormalise,
        Self::InPlaneAxes,
        Self::ExactCeiling,
    ];

    /// What it is called in scene files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::BroadPhase => "broad_phase",
            Self::Hierarchy => "hierarchy",
            Self::Degenerate => "degenerate",
            Self::Transform => "transform",
            Self::Renormalise => "renormalise",
            Self::InPlaneAxes => "in_plane_axes",
            Self::ExactCeiling => "exact_ceiling",
        }
    }

    /// Whether it is a stage of the unit, not of the software before it.
    pub fn is_hardware(self) -> bool {
        self >= Self::Transform
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether a stage is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Switch {
    /// If the scene needs it.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

impl Switch {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Auto, Self::On, Self::Off];

    /// What it is called in scene files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::On => "on",
            Self::Off => "off",
        }
    }
}

/// One switch for each effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Switches([Switch; Effect::ALL.len()]);

impl Switches {
    /// The switch of an effect.
    pub fn get(&self, effect: Effect) -> Switch {
        self.0[effect as usize]
    }

    /// Sets the switch of an effect.
    pub fn set(&mut self, effect: Effect, switch: Switch) {
        self.0[effect as usize] = switch;
    }
}

/// An option of the command line that a scene file gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name without dashes; there is such an option.
    pub name: String,
    /// Its value as it would be typed, which may be illegal.
    pub value: String,
    /// The line of the file, counted from 1.
    pub line: usize,
}

/// The tables `[effects]` and `[parameters]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Which stages are there.
    pub switches: Switches,
    /// The share of the surviving pairs that may become possibly incorrect by leaving out stages, 0 to 1.
    pub allowed: f64,
    /// Options of the design, in the order of their names.
    pub parameters: Vec<Parameter>,
}

impl Settings {
    /// The settings of a scene that was read from a file.
    ///
    /// # Errors
    /// An entry that is not understood: what was found and what is expected.
    pub fn of(scene: &Scene, file: &Path) -> Result<Self, SceneError> {
        let at = |line| move |message| SceneError { file: file.to_owned(), line: Some(line), message };
        let mut settings = Self::default();
        for entry in &scene.effects {
            settings.switch(entry).map_err(at(entry.line))?;
        }
        for entry in &scene.parameters {
            let parameter = settings.parameter(entry).map_err(at(entry.line))?;
            settings.parameters.push(parameter);
        }
        Ok(settings)
    }

    /// Takes an entry of `[effects]`.
    fn switch(&mut self, entry: &Entry) -> Result<(), String> {
        if entry.key == ALLOWED {
            self.allowed = share(&entry.value)?;
        } else {
            self.switches.set(effect(&entry.key)?, switch(&entry.value)?);
        }
        Ok(())
    }

    /// Reads an entry of `[parameters]`.
    fn parameter(&self, Entry { key: name, value, line }: &Entry) -> Result<Parameter, String> {
        if !Params::OPTIONS.iter().any(|option| option.name == name) {
            let legal: Vec<&str> = Params::OPTIONS.iter().map(|option| option.name).collect();
            return Err(format!("parameter '{name}': expected one of {}", legal.join(", ")));
        }
        let is_given = |effect: Effect| self.switches.get(effect) != Switch::Auto;
        if let Some((_, effect)) = STAGES.iter().find(|(option, effect)| option == name && is_given(*effect)) {
            return Err(format!("parameter '{name}' beside the effect '{effect}': expected one of the two"));
        }
        let value = match value {
            Value::String(text) => text.clone(),
            Value::Integer(number) => number.to_string(),
            _ => return Err(format!("{name} {}: expected a whole number or a word in quotes", found(value))),
        };
        Ok(Parameter { name: name.clone(), value, line: *line })
    }
}

fn effect(name: &str) -> Result<Effect, String> {
    Effect::ALL.into_iter().find(|effect| effect.name() == name).ok_or_else(|| {
        let legal = Effect::ALL.map(Effect::name).join(", ");
        format!("effect '{name}': expected one of {legal}, {ALLOWED}")
    })
}

fn switch(value: &Value) -> Result<Switch, String> {
    Switch::ALL.into_iter().find(|switch| value.as_str() == Some(switch.name())).ok_or_else(|| {
        let legal = Switch::ALL.map(|switch| format!("\"{}\"", switch.name())).join(", ");
        format!("{}: expected one of {legal}", found(value))
    })
}

fn share(value: &Value) -> Result<f64, String> {
    let number = match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    };
    let legal = |number: &f64| (0.0..=1.0).contains(number);
    number.filter(legal).ok_or_else(|| format!("{ALLOWED} {}: expected a number from 0 to 1", found(value)))
}

/// What stands in the file, in a few words.
fn found(value: &Value) -> String {
    match value {
        Value::String(text) => format!("'{text}'"),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(flag) => flag.to_string(),
        other => format!("a value of type {}", other.type_str()),
    }
}
