//! Families that the open tools know, each with its tools.

use efsat_hardware::device::{self, Device, Family};
use efsat_unit::params::options::Choice;

/// The tools for a family: Yosys counts for all, nextpnr places and routes for the ECP5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flow(Family);

impl Choice for Flow {
    const ALL: &'static [Self] = &[
        Self(Family::Virtex2),
        Self(Family::Spartan6),
        Self(Family::Series7),
        Self(Family::UltraScalePlus),
        Self(Family::Ecp5),
        Self(Family::Nexus),
    ];

    fn name(self) -> &'static str {
        match self.0 {
            Family::Virtex2 => "yosys-xc2v",
            Family::Spartan6 => "yosys-xc6s",
            Family::Series7 => "yosys-xc7",
            Family::UltraScalePlus => "yosys-xcup",
            Family::Ecp5 => "ecp5",
            Family::Nexus => "nexus",
        }
    }
}

impl Flow {
    /// The flow for a device.
    pub fn of(device: &Device) -> Self {
        Self(device.family)
    }

    /// The family.
    pub fn family(self) -> Family {
        self.0
    }

    /// The device that cells are predicted for: the given one if it is of the flow's family, else the family's first.
    pub fn device(self, given: &'static Device) -> &'static Device {
        let mut candidates = std::iter::once(given).chain(device::all());
        candidates.find(|device| device.family == self.0).unwrap_or(given)
    }

    /// Whether placement and routing follow.
    pub fn routes(self) -> bool {
        // Not Nexus: its open router does not end on the default design.
        self.0 == Family::Ecp5
    }
}
