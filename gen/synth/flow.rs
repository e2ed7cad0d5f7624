//! Families that the open tools know, each with its tools.

use crate::device::{self, Device, Family};

/// A family and the tools for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Virtex-II, counted by Yosys.
    Virtex2,
    /// Spartan-6, counted by Yosys.
    Spartan6,
    /// 7-series, counted by Yosys.
    Series7,
    /// ECP5, counted by Yosys, placed and routed by nextpnr.
    Ecp5,
}

impl Flow {
    /// All flows.
    pub const ALL: [Self; 4] = [Self::Virtex2, Self::Spartan6, Self::Series7, Self::Ecp5];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Virtex2 => "yosys-xc2v",
            Self::Spartan6 => "yosys-xc6s",
            Self::Series7 => "yosys-xc7",
            Self::Ecp5 => "ecp5",
        }
    }

    /// The flow for a device.
    pub fn of(device: &Device) -> Self {
        match device.family {
            Family::Virtex2 => Self::Virtex2,
            Family::Spartan6 => Self::Spartan6,
            Family::Series7 => Self::Series7,
            Family::Ecp5 => Self::Ecp5,
        }
    }

    /// The family.
    pub fn family(self) -> Family {
        match self {
            Self::Virtex2 => Family::Virtex2,
            Self::Spartan6 => Family::Spartan6,
            Self::Series7 => Family::Series7,
            Self::Ecp5 => Family::Ecp5,
        }
    }

    /// The device that cells are predicted for: the given one if it is of the flow's family, else the family's first.
    pub fn device(self, given: &'static Device) -> &'static Device {
        let mut candidates = std::iter::once(given).chain(device::all());
        candidates.find(|device| device.family == self.family()).unwrap_or(given)
    }

    /// Whether placement and routing follow.
    pub fn routes(self) -> bool {
        self == Self::Ecp5
    }
}
