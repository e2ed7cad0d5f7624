//! What a plan is asked for.

use efsat_geometry::collide::hierarchy::Directions;
use efsat_unit::host::settings::{Effect, Settings, Switch};
use efsat_unit::params::Params;
use serde::Serialize;

/// Who decides on a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Wish {
    /// The scene: the stage is there if it is needed.
    Auto,
    /// The user wants it.
    On,
    /// The user does not want it.
    Off,
    /// The user gave the option that says it; it stands in the parameters.
    Option,
}

impl From<Switch> for Wish {
    fn from(switch: Switch) -> Self {
        match switch {
            Switch::Auto => Self::Auto,
            Switch::On => Self::On,
            Switch::Off => Self::Off,
        }
    }
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The parameters of the unit; what they say of stages counts only where the wish is [`Wish::Option`].
    pub params: Params,
    /// One wish for each of [`Effect::ALL`].
    pub wishes: [Wish; Effect::ALL.len()],
    /// The share of the surviving pairs that may become possibly incorrect.
    pub allowed: f64,
    /// Directions of the bounding volumes.
    pub directions: Directions,
    /// Whether units are built to see what they take.
    pub costs: bool,
}

impl Request {
    /// Parameters, and the settings of a scene file; costs are wanted.
    pub fn new(settings: &Settings, params: Params, directions: Directions) -> Self {
        let wishes = Effect::ALL.map(|effect| settings.switches.get(effect).into());
        Self { params, wishes, allowed: settings.allowed, directions, costs: true }
    }

    /// Who decides on an effect.
    pub fn wish(&self, effect: Effect) -> Wish {
        self.wishes[effect as usize]
    }
}
