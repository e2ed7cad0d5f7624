//! What the tests of all crates share: how much they do, what they say where a tool is missing, and what runs the examples in the
//! documentation of this one.

use crate::graph::evaluate::Evaluator;
use crate::graph::{Library, Sig, Signals};
use crate::netlist::Control;
use crate::netlist::simulate::Simulation;
use crate::op::Type;
use std::io::Write;

/// Whether everything is asked for, by `EFSAT_TESTS=full`, which `scripts/test full` sets.
///
/// # Panics
/// If the environment variable has another value than `full`.
#[must_use]
pub fn full() -> bool {
    match std::env::var("EFSAT_TESTS").as_deref() {
        Err(_) => false,
        Ok("full") => true,
        Ok(other) => panic!("EFSAT_TESTS={other}: expected full"),
    }
}

/// Says that a test leaves something out, because `missing`, such as `GHDL is not installed`.
///
/// The line goes to standard error past the capture of the test harness, so that it is seen where tests pass; `scripts/test`
/// counts these lines by their tests.
///
/// # Panics
/// If everything is asked for: then a missing tool is a failure.
pub fn skip(missing: impl std::fmt::Display) {
    assert!(!full(), "{missing}; expected every tool with EFSAT_TESTS=full");
    let thread = std::thread::current();
    let line = format!("skipped: {}: {missing}\n", thread.name().unwrap_or("unnamed"));
    // A closed standard error is no reason to fail.
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

/// What the examples in the documentation name.
pub mod examples {
    pub use super::{NUMBER, evaluated, simulated, value};
    pub use crate::graph::evaluate::Evaluator;
    pub use crate::graph::{Fact, Library, Phases, Port, Rate, Sig, Signals, instance};
    pub use crate::netlist::Control;
    pub use crate::netlist::lower::Lowering;
    pub use crate::op::{Add, Type};
    pub use crate::schedule::Scheduler;
    pub use crate::{device, dump};
}

/// Numbers in examples of the builder.
pub const NUMBER: Type = Type::signed(16, 0);

/// What a block computes of some [numbers](NUMBER) from -1000 to 1000, in each of its phases: for examples of the builder.
#[must_use]
pub fn evaluated(phases: usize, numbers: &[i128], body: impl for<'l> FnOnce(&[Sig<'l>]) -> Sig<'l>) -> Vec<i128> {
    let block = Library::default().block("example", &[], phases, |top| {
        let inputs = numbers.iter().map(|_| top.input(NUMBER, (-1000, 1000))).collect::<Vec<_>>();
        body(&inputs.named("x")).named("y")
    });
    let mut evaluator = Evaluator::new(&block);
    evaluator.run(numbers);
    let output = evaluator.flat().outputs[0];
    (0..phases).map(|phase| evaluator.at(output, phase)).collect()
}

/// The same in a block of one phase.
#[must_use]
pub fn value(numbers: &[i128], body: impl for<'l> FnOnce(&[Sig<'l>]) -> Sig<'l>) -> i128 {
    evaluated(1, numbers, body)[0]
}

/// Each output of a module in each clock, from each input in each clock: for examples of control logic.
#[must_use]
pub fn simulated(inputs: &[&[i128]], body: impl FnOnce(&Control)) -> Vec<Vec<i128>> {
    let control = Control::new("example", vec![]);
    body(&control);
    let module = control.finish();
    let clocks = inputs.first().map_or(1, |values| values.len());
    let mut simulation = Simulation::new(&module, clocks);
    for (port, values) in inputs.iter().enumerate() {
        values.iter().enumerate().for_each(|(clock, value)| simulation.set(port, clock, *value));
    }
    simulation.run();
    let output = |port: usize| (0..clocks).map(|clock| simulation.output(port, clock)).collect();
    (0..module.outputs.len()).map(output).collect()
}
