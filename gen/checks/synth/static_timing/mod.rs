//! Static timing of a netlist for Virtex-II, estimated as XST does it before placement.
//!
//! The netlist is what Yosys' `synth_xilinx -family xc2v` leaves, as JSON; where it keeps the hierarchy, modules are put
//! into each other here. Cell delays are those of [`efsat_hardware::device::virtex2::delay`], nets get theirs by the number of
//! loads. Carry chains, a table in front of its chain or multiplexer, and a table in front of its own flip-flop have no
//! net between them. What is not known is not made up: set-up and clock-to-output of MULT18X18S are in no public
//! report, so paths into and out of registered multipliers are given apart, without these.

mod cells;
mod flatten;

use crate::synth::netlist::Netlist;
use cells::Cells;
use efsat_hardware::device::virtex2::delay;

/// What placed designs take longer than this estimate: its reports of synthesis were exceeded after routing by 13 % in
/// the median and by more where nothing was constrained.
pub const DERATING: f64 = 1.25;

/// The longest path between flip-flops.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// Its length, clock-to-output and set-up included, ns.
    pub ns: f64,
    /// The clock that would allow.
    pub megahertz: f64,
    /// The clock after [`DERATING`].
    pub derated_megahertz: f64,
    /// The signals it passes, from register to register.
    pub path: Vec<String>,
    /// Paths at registered multipliers, which lack a figure each.
    pub beside_multipliers: BesideMultipliers,
}

/// Longest paths that begin or end in a registered multiplier (MULT18X18S), none if there is no such path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BesideMultipliers {
    /// From a flip-flop to an operand, the multiplier's set-up not included, ns.
    pub into: Option<f64>,
    /// From the product to a flip-flop, the multiplier's clock-to-output not included, ns.
    pub out_of: Option<f64>,
}

/// Why there is no timing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimingError {
    /// The netlist has no such module.
    #[error("the netlist has no {0}")]
    Missing(String),
    /// There is no path to be timed.
    #[error("{0} has no path between flip-flops")]
    NoPath(String),
    /// Gates that feed themselves.
    #[error("a loop of gates through {0}")]
    Loop(String),
}

/// Where a path began.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    FlipFlop,
    Multiplier,
}

/// The latest arrival at a net from each kind of start, and the net before on that path.
type Arrivals = [Option<(f64, Option<usize>)>; 2];

/// The timing of module `top` of a netlist.
///
/// # Errors
/// No such module, no path, or a combinational loop.
pub fn estimate(netlist: &Netlist, top: &str) -> Result<Timing, TimingError> {
    let design = flatten::flatten(netlist, top).ok_or_else(|| TimingError::Missing(top.to_owned()))?;
    let cells = Cells::new(&design);
    let mut arrivals: Vec<Arrivals> = vec![[None; 2]; design.nets];
    for cell in cells.in_order()? {
        for (output, net) in cells.outputs(cell) {
            arrivals[net] = arrive(&cells, &arrivals, cell, output, net);
        }
    }
    let mut longest: [Option<(f64, usize)>; 2] = [None; 2];
    let mut into: Option<f64> = None;
    for end in cells.ends() {
        for (start, latest) in longest.iter_mut().enumerate() {
            let Some((ns, _)) = arrivals[end.net][start] else { continue };
            let ns = ns + cells.net_delay(end.net, end.cell, end.port) + end.setup.unwrap_or(0.0);
            if end.setup.is_none() {
                // Both figures are missing on a path from multiplier to multiplier; it counts as one into.
                into = Some(into.map_or(ns, |known| known.max(ns)));
            } else if latest.is_none_or(|known| ns > known.0) {
                *latest = Some((ns, end.net));
            }
        }
    }
    let [of_flip_flops, of_multipliers] = longest;
    let (ns, last) = of_flip_flops.ok_or_else(|| TimingError::NoPath(top.to_owned()))?;
    let beside_multipliers = BesideMultipliers { into, out_of: of_multipliers.map(|path| path.0) };
    let path = trace(&design, &arrivals, last);
    Ok(Timing { ns, megahertz: 1000.0 / ns, derated_megahertz: 1000.0 / (ns * DERATING), path, beside_multipliers })
}

/// The latest arrival at an output of a cell.
fn arrive(cells: &Cells, arrivals: &[Arrivals], cell: usize, output: (&str, usize), net: usize) -> Arrivals {
    let mut latest: Arrivals = [None; 2];
    if let Some((start, ns)) = cells.start(cell) {
        latest[start as usize] = Some((ns, None));
    }
    for (port, input) in cells.inputs(cell) {
        let Some(through) = cells.through(cell, port, output, net) else { continue };
        for start in [Start::FlipFlop, Start::Multiplier] {
            let Some((ns, _)) = arrivals[input][start as usize] else { continue };
            let ns = ns + cells.net_delay(input, cell, port) + through;
            if latest[start as usize].is_none_or(|known| ns > known.0) {
                latest[start as usize] = Some((ns, Some(input)));
            }
        }
    }
    latest
}

/// The names on the path to a net, each once.
fn trace(design: &flatten::Design, arrivals: &[Arrivals], last: usize) -> Vec<String> {
    let before = |net: &usize| arrivals[*net][Start::FlipFlop as usize].and_then(|arrival| arrival.1);
    let mut names: Vec<String> =
        std::iter::successors(Some(last), before).filter_map(|net| design.names[net].clone()).collect();
    names.reverse();
    names.dedup();
    names
}

#[cfg(test)]
mod tests;
