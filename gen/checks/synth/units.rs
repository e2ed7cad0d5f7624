//! The design's units as a tree, each with predicted and actual cells.

use super::cells::{self, Cells};
use super::static_timing::{self, Timing};
use super::{Flow, VERILOG};
use crate::synth::netlist::Netlist;
use crate::synth::tools::Tool;
use crate::synth::{ToolError, yosys};
use efsat_engine::artefact::NAME;
use efsat_engine::artefact::cells::Entity;
use efsat_hardware::device::{Device, Resources};
use efsat_hardware::{estimate, netlist::Module};
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
    /// What is predicted for one instance with everything in it.
    pub predicted: Resources,
    /// What the synthesis tool made of one instance with everything in it; none if none ran.
    pub actual: Option<Cells>,
    /// The units in it.
    pub parts: Vec<Unit>,
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

/// An entity of the control of an engine, with everything in it.
pub(super) fn around(entity: &Entity, units: &[&Module], device: &Device, netlist: Option<(&Netlist, Flow)>) -> Unit {
    let mut parts: Vec<Unit> = entity.parts.iter().map(|part| around(part, units, device, netlist)).collect();
    if entity.name == NAME {
        parts.extend(units.iter().map(|module| unit(module, 1, device, netlist)));
        parts.sort_by(|x, y| x.entity.cmp(&y.entity));
    }
    gathered(entity.name, entity.instances, entity.own.resources, parts, netlist)
}

fn unit(module: &Module, instances: u64, device: &Device, netlist: Option<(&Netlist, Flow)>) -> Unit {
    let mut kinds: Vec<(&Module, u64)> = vec![];
    for instance in &module.instances {
        match kinds.iter_mut().find(|(known, _)| known.name == instance.module.name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((&instance.module, 1)),
        }
    }
    let parts = kinds.into_iter().map(|(part, count)| unit(part, count, device, netlist)).collect();
    gathered(&module.name, instances, estimate::own(module, device), parts, netlist)
}

/// A unit of which is known what it is predicted to take by itself, and its parts.
fn gathered(name: &str, instances: u64, own: Resources, parts: Vec<Unit>, netlist: Option<(&Netlist, Flow)>) -> Unit {
    let mapped = |(netlist, flow): (&Netlist, Flow)| {
        netlist.modules.get(name).map(|module| cells::own(module, flow.family())).unwrap_or_default()
    };
    let in_parts = parts.iter().filter_map(|part| part.actual.map(|cells| cells * part.instances));
    let actual = netlist.map(|netlist| in_parts.fold(mapped(netlist), Add::add));
    let below: Resources = parts.iter().map(|part| part.predicted * part.instances).sum();
    Unit { entity: name.to_owned(), instances, predicted: own + below, actual, parts }
}
