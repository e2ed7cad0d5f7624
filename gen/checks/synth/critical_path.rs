//! nextpnr's longest path in the names of the design.
//!
//! Yosys names a net without a name after what it leads to (`a_max_hi_LUT4_Z_17_D`), so a net belongs to the signal of
//! the design whose name is the longest beginning of its own; GHDL's numbered nets belong to none and are part of the
//! way to the next. A bundle that is printed as a record or an array is one net; an instance in a generate statement has
//! the statement's label and the iteration, counted from one, in its name.

use super::harness;
use super::netlist::{Netlist, is_ours};
use efsat_hardware::graph::{Place, Step as PathStep};
use efsat_hardware::netlist::Module;
use efsat_hardware::vhdl::generated_instance;
use serde::Deserialize;
use std::collections::HashMap;

/// A signal on a path, with the delay since the signal before, ns.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Labels of the instances from the top down, and the signal's name.
    pub signal: String,
    /// Delay in cells.
    pub logic: f64,
    /// Delay in nets.
    pub routing: f64,
}

/// A path from register to register; the last step is the set-up of a register.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CriticalPath {
    /// Signals in the order of the path.
    pub steps: Vec<Step>,
}

/// Name of the last step.
const SETUP: &str = "set-up";

impl CriticalPath {
    /// Delay in cells, ns.
    pub fn logic(&self) -> f64 {
        self.steps.iter().map(|step| step.logic).sum()
    }

    /// Delay in nets, ns.
    pub fn routing(&self) -> f64 {
        self.steps.iter().map(|step| step.routing).sum()
    }
}

/// A path of nextpnr's report.
#[derive(Deserialize)]
pub(super) struct RawPath {
    from: String,
    to: String,
    path: Vec<RawStep>,
}

#[derive(Deserialize)]
struct RawStep {
    #[serde(rename = "type")]
    kind: String,
    delay: f64,
    net: Option<String>,
}

/// The names of all signals of a design by those of their nets, each with the labels of the instances it is in.
pub(super) struct Names(HashMap<String, String>);

impl Names {
    /// The names in a top module.
    pub fn new(top: &Module) -> Self {
        fn collect(module: &Module, nets: &str, prefix: &str, names: &mut HashMap<String, String>) {
            let signals = module.signals.iter().map(|signal| &signal.place);
            for place in signals.chain(module.outputs.iter().map(|(place, _)| place)).filter(|place| !place.is_empty())
            {
                // The bundle itself, its fields as far as each is printed on its own, and every element.
                let held = place.held().map(|(suffix, _)| Place { suffix: format!("{suffix}_held"), ..place.clone() });
                for place in std::iter::once(place.clone()).chain(held) {
                    for net in [Place { path: vec![], ..place.clone() }, fields(&place), place.clone()] {
                        names.insert(format!("{nets}{net}"), format!("{prefix}{net}"));
                    }
                }
            }
            for instance in &module.instances {
                let place = &instance.place;
                let label = place.to_string();
                let short = ["_unit", "_section"].iter().find_map(|end| label.strip_suffix(end)).unwrap_or(&label);
                for net in generated_instance(place).iter().chain([&label]) {
                    collect(&instance.module, &format!("{nets}{net}."), &format!("{prefix}{short}."), names);
                }
            }
        }
        let mut names = HashMap::new();
        collect(top, "", "", &mut names);
        Self(names)
    }

    /// The names in a top module of a netlist: every signal that is neither Yosys' nor GHDL's own.
    pub fn of_netlist(netlist: &Netlist, top: &str) -> Self {
        let mut names = HashMap::new();
        collect_named(netlist, top, "", &mut names);
        Self(names)
    }

    /// The signal that a net of the whole belongs to.
    fn signal(&self, net: &str) -> Option<String> {
        let (place, name) = net.split_once('.').unwrap_or(("", net));
        if place != harness::INSTANCE {
            let ours = !net.starts_with('$') && place.is_empty();
            return ours.then(|| harness::TOP.to_owned());
        }
        let name = name.split('[').next().unwrap_or(name);
        let ends = name.match_indices(['_', '$']).map(|(at, _)| at).chain([name.len()]);
        let beginnings: Vec<&str> = ends.map(|end| &name[..end]).collect();
        beginnings.into_iter().rev().find_map(|name| self.0.get(name)).cloned()
    }
}

fn collect_named(netlist: &Netlist, module: &str, prefix: &str, names: &mut HashMap<String, String>) {
    let Some(module) = netlist.modules.get(module).filter(|module| !module.is_library()) else { return };
    for name in module.netnames.keys().filter(|name| is_ours(name)) {
        names.insert(format!("{prefix}{name}"), format!("{prefix}{name}"));
    }
    for (label, cell) in &module.cells {
        collect_named(netlist, &cell.kind, &format!("{prefix}{label}."), names);
    }
}

/// A name without what has become an index.
fn fields(place: &Place) -> Place {
    let path = place.path.iter().filter(|step| matches!(step, PathStep::Field(..) | PathStep::Beside(_)));
    Place { path: path.copied().collect(), ..place.clone() }
}

/// The longest path from register to register; without steps if there is none.
pub(super) fn longest(paths: &[RawPath], names: &Names) -> CriticalPath {
    let clocked = |path: &&RawPath| path.from.starts_with("posedge") && path.to.starts_with("posedge");
    let delay = |path: &RawPath| path.path.iter().map(|step| step.delay).sum::<f64>();
    let longest = paths.iter().filter(clocked).max_by(|a, b| delay(a).total_cmp(&delay(b)));
    longest.map(|path| follow(&path.path, names)).unwrap_or_default()
}

fn follow(path: &[RawStep], names: &Names) -> CriticalPath {
    let mut steps: Vec<Step> = vec![];
    let (mut logic, mut routing) = (0.0, 0.0);
    for raw in path {
        if raw.kind != "routing" {
            logic += raw.delay;
            continue;
        }
        if let Some(signal) = raw.net.as_deref().and_then(|net| names.signal(net)) {
            match steps.last_mut() {
                Some(last) if last.signal == signal => {
                    last.logic += logic;
                    last.routing += routing;
                }
                _ => steps.push(Step { signal, logic, routing }),
            }
            (logic, routing) = (0.0, 0.0);
        }
        routing += raw.delay;
    }
    // Where no net of the path has a name of the design, the instance that it begins in says where it is.
    let begins = || path.iter().find_map(|raw| raw.net.as_deref()?.strip_prefix(harness::INSTANCE)?.rsplit_once('.'));
    if let (true, Some((place, _))) = (steps.is_empty(), begins()) {
        steps.push(Step { signal: place.trim_start_matches('.').to_owned(), logic: 0.0, routing: 0.0 });
    }
    steps.push(Step { signal: SETUP.to_owned(), logic, routing });
    CriticalPath { steps }
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_unit::design::{Design, Probes};
    use efsat_unit::params::Params;

    fn names() -> Names {
        let names = ["path.cmp.a_max_d1", "path.cmp.a_max", "path.cmp.a_below_b"];
        Names(names.map(|name| (name.to_owned(), name.to_owned())).into())
    }

    #[test]
    fn nets_belong_to_signals() {
        let signal = |net: &str| names().signal(net);
        assert_eq!(signal("unit.path.cmp.a_max_d1[2]").as_deref(), Some("path.cmp.a_max_d1"));
        assert_eq!(signal("unit.path.cmp.a_max_LUT4_Z_17_D[5]").as_deref(), Some("path.cmp.a_max"));
        assert_eq!(signal("unit.path.cmp.a_max$CCU2_FCI_INT").as_deref(), Some("path.cmp.a_max"));
        assert_eq!(signal("given[3]").as_deref(), Some("harness"));
        assert_eq!(signal("unit.path.cmp.n3813_q"), None);
        assert_eq!(signal("$nextpnr_CCU2C_707$CIN"), None);
    }

    #[test]
    fn nets_in_generate_statements_belong_to_signals() {
        let params = Params::default();
        let names = Names::new(&Design::new(&params, Probes::None).unwrap().top);
        let signal = |net: &str| names.signal(net);
        assert_eq!(
            signal("unit.path.pair_axes_section.p_unit_n1_unit.exact[12]").as_deref(),
            Some("path.pair_axes.p0.exact")
        );
        assert_eq!(
            signal("unit.path.pair_axes_section.p_unit_n2_unit.exact[12]").as_deref(),
            Some("path.pair_axes.p1.exact")
        );
        let part = "unit.path.pair_axes_section.p_unit_n2_unit.term_unit_n3_unit.p_lo";
        assert_eq!(signal(part).as_deref(), Some("path.pair_axes.p1.term_z.p_lo"));
    }

    #[test]
    fn delays_add_up_between_signals() {
        let text = r#"[{"from": "posedge clk", "to": "<async>", "path": [{"type": "routing", "delay": 99.0}]},
            {"from": "posedge clk", "to": "posedge clk", "path": [
            {"type": "clk-to-q", "delay": 0.5},
            {"type": "routing", "delay": 1.0, "net": "unit.path.cmp.a_max_d1[2]"},
            {"type": "logic", "delay": 0.25},
            {"type": "routing", "delay": 2.0, "net": "unit.path.cmp.n12_q"},
            {"type": "logic", "delay": 0.5},
            {"type": "routing", "delay": 4.0, "net": "unit.path.cmp.a_max_LUT4_Z_D"},
            {"type": "logic", "delay": 0.125},
            {"type": "routing", "delay": 8.0, "net": "unit.path.cmp.a_max[0]"},
            {"type": "setup", "delay": 0.0}]}]"#;
        let path = longest(&serde_json::from_str::<Vec<RawPath>>(text).unwrap(), &names());
        let step = |signal: &str, logic, routing| Step { signal: signal.to_owned(), logic, routing };
        let expected = [step("path.cmp.a_max_d1", 0.5, 0.0), step("path.cmp.a_max", 0.875, 7.0), step(SETUP, 0.0, 8.0)];
        assert_eq!(path.steps, expected);
        assert_eq!((path.logic(), path.routing()), (1.375, 15.0));
    }
}
