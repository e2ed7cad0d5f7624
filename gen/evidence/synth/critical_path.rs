//! nextpnr's longest path in the names of the design.
//!
//! Yosys names a net without a name after what it leads to (`a_max_hi_LUT4_Z_17_D`), so a net belongs to the signal of
//! the design whose name is the longest beginning of its own; GHDL's numbered nets belong to none and are part of the
//! way to the next.

use super::harness;
use efsat_hardware::netlist::Module;
use serde::Deserialize;
use std::collections::HashSet;

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

/// The names of all signals of a design, each with the labels of the instances it is in.
pub(super) struct Names(HashSet<String>);

impl Names {
    /// The names in a top module.
    pub fn new(top: &Module) -> Self {
        fn collect(module: &Module, prefix: &str, names: &mut HashSet<String>) {
            names.extend(module.signals.iter().map(|signal| format!("{prefix}{}", signal.name())));
            names.extend(module.outputs.iter().map(|(name, _)| format!("{prefix}{name}")));
            for instance in &module.instances {
                collect(&instance.module, &format!("{prefix}{}.", instance.place), names);
            }
        }
        let mut names = HashSet::new();
        collect(top, "", &mut names);
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
        beginnings.into_iter().rev().find(|name| self.0.contains(*name)).map(str::to_owned)
    }
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
    steps.push(Step { signal: SETUP.to_owned(), logic, routing });
    CriticalPath { steps }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Names {
        Names(["path.cmp.a_max_d1", "path.cmp.a_max", "path.cmp.a_below_b"].map(str::to_owned).into())
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
