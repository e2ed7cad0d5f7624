//! The design's units as a tree, each with predicted and actual cells.

use super::cells::{self, Cells};
use super::static_timing::{self, Timing};
use super::{Flow, VERILOG};
use crate::synth::netlist::Netlist;
use crate::synth::tools::Tool;
use crate::synth::{ToolError, yosys};
use efsat_hardware::device::{Device, Resources};
use efsat_hardware::{estimate, netlist::Module};
use std::collections::BTreeSet;
use std::ops::Add;
use std::path::Path;

/// File of the netlist with one module an entity.
const NETLIST: &str = "units.json";

/// A unit: an entity of the design in its place.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Name of the entity.
    pub entity: String,
    /// Instances of it in the unit around it.
    pub instances: u64,
    /// What the device model predicts for one instance with everything in it; none of an entity around units of ours.
    pub predicted: Option<Resources>,
    /// What the synthesis tool made of one instance with everything in it; none if none ran.
    pub actual: Option<Cells>,
    /// The units in it.
    pub parts: Vec<Unit>,
}

impl Unit {
    /// What is predicted of it, or of the units in it if it is not predicted itself.
    pub fn foreseen(&self) -> Resources {
        let of_parts = || self.parts.iter().map(|part| part.foreseen() * part.instances).sum();
        self.predicted.unwrap_or_else(of_parts)
    }
}

/// Maps entity by entity, so that nothing is shared between units and every cell belongs to one.
///
/// # Errors
/// What Yosys says.
pub(super) fn netlist(yosys: &Tool, flow: Flow, top: &str, dir: &Path) -> Result<Netlist, ToolError> {
    let read = yosys::read(flow.family(), VERILOG, dir)?;
    let commands = format!("{read}{}write_json {NETLIST}\n", yosys::units(flow.family(), top));
    yosys::run(yosys, "units", &commands, dir)?;
    Netlist::read(&dir.join(NETLIST))
}

/// Static timing of a netlist of units.
///
/// # Errors
/// A netlist that has no timing.
pub(super) fn timing(netlist: &Netlist, top: &str) -> Result<Timing, ToolError> {
    static_timing::estimate(netlist, top).map_err(|e| ToolError::failed("static timing", e.to_string()))
}

/// The units of a hierarchy, the top first, predicted for a device, and counted where there is a netlist of a flow.
pub(super) fn tree(top: &Module, device: &Device, netlist: Option<(&Netlist, Flow)>) -> Unit {
    unit(top, 1, device, netlist)
}

/// An entity around units of ours, which alone are predicted. Where there is a netlist, all entities in between are told.
pub(super) fn around(top: &str, units: &[&Module], device: &Device, netlist: Option<(&Netlist, Flow)>) -> Unit {
    if let Some(netlist) = netlist {
        return below(top, 1, units, device, netlist);
    }
    let parts: Vec<Unit> = units.iter().map(|module| unit(module, 1, device, None)).collect();
    Unit { entity: top.to_owned(), instances: 1, predicted: None, actual: None, parts }
}

fn below(name: &str, instances: u64, known: &[&Module], device: &Device, (netlist, flow): (&Netlist, Flow)) -> Unit {
    if let Some(module) = known.iter().find(|module| module.name == name) {
        return unit(module, instances, device, Some((netlist, flow)));
    }
    let module = &netlist.modules[name];
    let ours = |kind: &&str| netlist.modules.get(*kind).is_some_and(|module| !module.is_library());
    let kinds: Vec<&str> = module.cells.values().map(|cell| cell.kind.as_str()).filter(ours).collect();
    let count = |kind: &str| kinds.iter().filter(|other| **other == kind).count() as u64;
    let parts: BTreeSet<&str> = kinds.iter().copied().collect();
    let parts: Vec<Unit> =
        parts.into_iter().map(|kind| below(kind, count(kind), known, device, (netlist, flow))).collect();
    let in_parts = parts.iter().filter_map(|part| part.actual.map(|cells| cells * part.instances));
    let actual = Some(in_parts.fold(cells::own(module, flow.family()), Add::add));
    Unit { entity: name.to_owned(), instances, predicted: None, actual, parts }
}

fn unit(module: &Module, instances: u64, device: &Device, netlist: Option<(&Netlist, Flow)>) -> Unit {
    let mut kinds: Vec<(&Module, u64)> = vec![];
    for instance in &module.instances {
        match kinds.iter_mut().find(|(known, _)| known.name == instance.module.name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((&instance.module, 1)),
        }
    }
    let parts: Vec<Unit> = kinds.into_iter().map(|(part, count)| unit(part, count, device, netlist)).collect();
    let own = |(netlist, flow): (&Netlist, Flow)| {
        netlist.modules.get(&module.name).map(|module| cells::own(module, flow.family())).unwrap_or_default()
    };
    let in_parts = parts.iter().filter_map(|part| part.actual.map(|cells| cells * part.instances));
    let actual = netlist.map(|netlist| in_parts.fold(own(netlist), Add::add));
    let below: Resources = parts.iter().map(|part| part.foreseen() * part.instances).sum();
    let predicted = Some(estimate::own(module, device) + below);
    Unit { entity: module.name.clone(), instances, predicted, actual, parts }
}
