//! What a scene file says of the unit that is to serve it.

use std::fmt;

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
