//! A delay line with a tap, as an entity of its own: one look-up table per bit on devices whose tables are shift registers.

use super::module::{Driver, LINE_CLOCKS, Module, Signal, SignalId};
use crate::graph::Place;
use crate::op::Type;
use std::rc::Rc;

/// The line for numbers of a type: `y = x`, `tap + 1` clocks before.
pub(super) fn tapped_line(ty: Type) -> Rc<Module> {
    let doc = vec![
        format!(
            "What x was tap + 1 clocks before, up to {LINE_CLOCKS}: a shift register for each bit, which is one look-up"
        ),
        "table (SRL16). Takes the place of registers for several values and of the multiplexer behind them.".to_owned(),
    ];
    let mut module = Module::new(&format!("tapped_line_{}{}", if ty.signed { "" } else { "u" }, ty.bits), doc);
    let plain = Type { fraction: None, ..ty };
    let mut push = |name: &str, ty, driver| {
        let (place, comment) = (Place::new(name), String::new());
        module.signals.push(Signal { place, named: true, ty, driver, comment, range: None, clock: None });
        SignalId(module.signals.len() - 1)
    };
    let (x, tap) = (push("x", plain, Driver::Port), push("tap", Type::index(LINE_CLOCKS), Driver::Port));
    let tapped = push("tapped", plain, Driver::Line { data: x, tap });
    module.inputs = vec![x, tap];
    module.outputs = vec![(Place::new("y"), tapped)];
    Rc::new(module)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::netlist::simulate::Simulation;

    #[test]
    fn what_comes_out_is_what_was_there_tap_and_one_clocks_before() {
        let line = tapped_line(Type::signed(18, 0));
        let (x, tap) = (|t: usize| (t * t % 1009) as i128 - 500, |t: usize| t * 7 % LINE_CLOCKS);
        for block in [1, 5, LINE_CLOCKS, 50] {
            let mut simulation = Simulation::new(&line, block);
            for first in (0..200).step_by(block) {
                for t in 0..block {
                    simulation.set(0, t, x(first + t));
                    simulation.set(1, t, tap(first + t) as i128);
                }
                simulation.run();
                for t in 0..block {
                    let expected = (first + t).checked_sub(tap(first + t) + 1).map_or(0, x);
                    assert_eq!(simulation.output(0, t), expected, "blocks of {block}, clock {}", first + t);
                }
            }
        }
    }
}
