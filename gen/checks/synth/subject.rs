//! What is synthesised: the unit alone, or the collision engine with the unit in it.

use super::critical_path::Names;
use super::netlist::Netlist;
use super::{Flow, Report, harness, units};
use efsat_engine::artefact as engine;
use efsat_engine::artefact::EngineDesign;
use efsat_hardware::vhdl::Clash;
use efsat_unit::artefact::{Prefix, vhdl_files};
use efsat_unit::design::Design;

/// What is synthesised.
pub enum Subject<'a> {
    /// The triangle unit.
    Unit(&'a Design),
    /// The engine.
    Engine(&'a EngineDesign),
}

impl Subject<'_> {
    /// The triangle unit, which an engine has in it.
    pub fn unit(&self) -> &Design {
        match self {
            Self::Unit(design) => design,
            Self::Engine(engine) => &engine.unit,
        }
    }

    /// Name of the top entity.
    pub fn top(&self) -> &str {
        match self {
            Self::Unit(design) => &design.top.name,
            Self::Engine(design) => design.top(),
        }
    }

    /// Name and text of each source, in dependency order.
    pub(super) fn sources(&self, command_line: &str) -> Result<Vec<(String, String)>, Clash> {
        match self {
            Self::Unit(design) => vhdl_files(design, &Prefix::default(), command_line),
            Self::Engine(design) => engine::engine_files(design, &Prefix::default(), command_line),
        }
    }

    /// What the device model says, for a flow that does not run.
    pub fn predict(&self, flow: Flow) -> Report {
        self.modelled(flow, None)
    }

    /// What the model and the schedule say, beside the counts of a netlist of units.
    pub(super) fn modelled(&self, flow: Flow, netlist: Option<&Netlist>) -> Report {
        let unit = self.unit();
        let counted_for = flow.device(unit.device);
        let netlist = netlist.map(|netlist| (netlist, flow));
        let (top, clock, expansion_clocks, predicted_block_rams) = match self {
            Self::Unit(_) => (units::tree(&unit.top, counted_for, netlist), unit.clock(), None, 0),
            Self::Engine(design) => {
                let volume = &design.volume;
                let control = design.control(counted_for);
                let top = units::around(&control, &design.units(), counted_for, netlist);
                (top, design.clock(), Some(volume.interval), control.whole().block_rams)
            }
        };
        Report {
            flow,
            counted_for,
            tools: vec![],
            top,
            interval: unit.interval,
            latency: unit.latency,
            expansion_clocks,
            predicted_block_rams,
            scheduled: (clock.0, clock.1.to_owned()),
            timing: None,
            routed: None,
        }
    }

    /// The harness for placement.
    pub(super) fn harness(&self, netlist: &Netlist) -> String {
        match self {
            Self::Unit(design) => harness::of_module(&design.top),
            Self::Engine(_) => harness::of_netlist(self.top(), "aclk", &netlist.modules[self.top()]),
        }
    }

    /// The signals that a path is told in.
    pub(super) fn names(&self, netlist: &Netlist) -> Names {
        match self {
            Self::Unit(design) => Names::new(&design.top),
            Self::Engine(_) => Names::of_netlist(netlist, self.top()),
        }
    }
}
