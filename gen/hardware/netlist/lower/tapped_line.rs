//! A delay line with a tap in place of a multiplexer and of the registers in front of it: an entity of its own, one look-up table
//! per bit on devices whose tables are shift registers.

use super::Lowered;
use crate::graph::{NodeId, Op, Place, Step};
use crate::netlist::module::{Driver, Home, Instance, LINE_CLOCKS, Module, Signal, SignalId};
use crate::op::Type;
use std::rc::Rc;

/// The line for numbers of a type: `y = x`, `tap + 1` clocks before.
fn tapped_line(ty: Type) -> Rc<Module> {
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
        let (range, clock, home) = (None, None, Home::default());
        module.signals.push(Signal { place, named: true, ty, driver, comment, range, clock, home });
        SignalId(module.signals.len() - 1)
    };
    let (x, tap) = (push("x", plain, Driver::Port), push("tap", Type::index(LINE_CLOCKS), Driver::Port));
    let tapped = push("tapped", plain, Driver::Line { data: x, tap });
    module.inputs = vec![x, tap];
    module.outputs = vec![(Place::new("y"), tapped)];
    Rc::new(module)
}

impl Lowered<'_> {
    /// How many clocks before the value was there that a multiplexer takes in each phase, where a delay line with a tap can
    /// take its place, and the node of those values.
    pub(super) fn delays(&self, i: usize) -> Option<(usize, Vec<i32>)> {
        let (node, slot) = (&self.block.nodes[i], self.schedule.slots[i]);
        let Op::Mux { late } = &node.op else { return None };
        let Op::Phase(taken) = &self.block.node(node.args[0]).op else { return None };
        let in_time = self.device.tapped_line().is_some_and(|ns| ns <= slot.ns + 1e-9);
        if !in_time || node.ty.is_flag() || slot.from != slot.start || late.len() < 3 || late.contains(&true) {
            return None;
        }
        let captured = |arg: &NodeId| {
            let capture = &self.block.nodes[self.block.carrier(arg.0)];
            let Op::Capture { phase, late: false } = capture.op else { return None };
            Some((self.block.carrier(capture.args[0].0), phase))
        };
        let captures: Vec<(usize, usize)> = node.args[1..].iter().map(captured).collect::<Option<_>>()?;
        let stream = captures[0].0;
        let from = self.schedule.slots[stream].from;
        let alike = captures.iter().all(|c| c.0 == stream) && self.block.nodes[stream].ty.bits == node.ty.bits;
        // What was some phases before is a tap of a line already.
        if !alike || from == i32::MIN || matches!(self.block.nodes[stream].op, Op::Earlier(_)) {
            return None;
        }
        // An idle phase goes on with the value of the phase before, which is a clock older then.
        let first = taken.iter().position(Option::is_some)?;
        let mut delays = vec![0; taken.len()];
        let mut delay = 0;
        for s in (0..taken.len()).map(|s| (first + s) % taken.len()) {
            delay = match taken[s] {
                Some(k) => slot.start + s as i32 - from - captures[k as usize].1 as i32,
                None => delay + 1,
            };
            delays[s] = delay;
        }
        let (least, most) = (*delays.iter().min()?, *delays.iter().max()?);
        (least > 0 && most - least < LINE_CLOCKS as i32).then_some((stream, delays))
    }

    /// Puts a delay line with a tap in the place of a multiplexer.
    pub(super) fn tapped(&mut self, i: usize, (stream, delays): &(usize, Vec<i32>)) {
        let block = Rc::clone(&self.block);
        let (node, start) = (&block.nodes[i], self.schedule.slots[i].start);
        // What is delayed more than a line can goes through registers first.
        let most = delays.iter().max().copied().unwrap_or(0);
        let before = if most > LINE_CLOCKS as i32 { delays.iter().min().map_or(0, |least| least - 1) } else { 0 };
        let data = self.delayed(*stream, before);
        let tap = self.tap(node.args[0].0, start, delays, before);
        let line = self.lines.entry((node.ty.signed, node.ty.bits)).or_insert_with(|| tapped_line(node.ty));
        let (place, module) = (node.place.suffixed("line"), Rc::clone(line));
        let instance = self.out.instances.len();
        self.out.instances.push(Instance { place, module, inputs: vec![data, tap] });
        self.of_node(i, Driver::Instance { instance, port: 0 });
    }

    /// The tap of a delay line that stands for multiplexers of an index: their delays, less `before` clocks of registers.
    fn tap(&mut self, select: usize, start: i32, delays: &[i32], before: i32) -> SignalId {
        let at = start.rem_euclid(self.interval());
        let taps: Vec<i32> = delays.iter().map(|delay| delay - before - 1).collect();
        let key = (select, at, taps.clone());
        if let Some(known) = self.taps.get(&key).copied() {
            self.read.entry(known).or_default().insert(start);
            return known;
        }
        // Elements of a bundle that were captured in different phases have taps of their own.
        let muxes = (0..self.block.nodes.len()).filter(|i| self.block.nodes[*i].args.first() == Some(&NodeId(select)));
        let mut all: Vec<Vec<i32>> = muxes.filter_map(|i| self.delays(i)).map(|(_, delays)| delays).collect();
        all.sort_unstable();
        all.dedup();
        let mut place = self.block.nodes[select].place.suffixed(&format!("tap_at_{at}"));
        if all.len() > 1 {
            place.path.push(Step::Index(all.iter().position(|d| d == delays).unwrap_or(0)));
        }
        let tap = self.by_phase(place, Type::index(LINE_CLOCKS), at, start, |phase| i128::from(taps[phase]));
        self.taps.insert(key, tap);
        tap
    }
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
