//! One evaluated point of a sweep.

use super::hardware::Cells;
use super::{Answers, Hardware};
use efsat_unit::params::options::{Affects, Choice};
use efsat_unit::params::{Method, Params};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Options by name, without dashes.
pub type Options = BTreeMap<String, String>;

/// All options of a parameter set.
pub fn options(params: &Params) -> Options {
    params.options().into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Those that its answers depend on.
pub fn model_options(options: &Options) -> Options {
    let answering = Params::OPTIONS.iter().filter(|option| option.affects != Affects::Hardware);
    answering.filter_map(|option| options.get_key_value(option.name)).map(|(n, v)| (n.clone(), v.clone())).collect()
}

/// A finished point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The parameters.
    pub options: Options,
    /// What it answers.
    pub answers: Answers,
    /// What it takes, and how fast it is.
    pub hardware: Hardware,
    /// Cells as Yosys maps them, where that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub synthesised: Option<Cells>,
}

impl Point {
    /// An option's value.
    pub fn option(&self, name: &str) -> &str {
        self.options.get(name).map_or("", String::as_str)
    }

    /// How it decides; designs of the default method do not spell it out.
    pub fn method(&self) -> &str {
        self.options.get("method").map_or(Method::Axes.name(), String::as_str)
    }

    /// The working width.
    pub fn width(&self) -> u32 {
        self.option("width").parse().unwrap_or(0)
    }

    /// Whether the parameters are those of `base` but for the named options.
    pub fn differs_only_in(&self, base: &Options, names: &[&str]) -> bool {
        self.options.iter().all(|(name, value)| names.contains(&name.as_str()) || base.get(name) == Some(value))
    }
}
