//! Multiplexers and what selects their operands: in one clock, or among the operands of each group in a first clock and among the
//! groups in a second one.

use super::Lowered;
use crate::graph::{Op, Place};
use crate::netlist::module::{Driver, SignalId};
use crate::op::{Lookup, Select, Type};
use crate::schedule::{GROUP, operand_phases};
use std::rc::Rc;

/// What is read of the index of a multiplexer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Digits {
    /// All of it.
    All,
    /// The place of the operand in its group.
    InGroup,
    /// The group.
    Group,
}

impl Lowered<'_> {
    pub(super) fn reserve_mux(&mut self, i: usize) -> SignalId {
        self.of_node(i, Driver::Combinational { op: Select::default().into(), args: vec![] })
    }

    pub(super) fn connect_mux(&mut self, i: usize, id: SignalId, operands: Vec<SignalId>) {
        let (select, slot) = (self.block.nodes[i].args[0].0, self.schedule.slots[i]);
        let (select, operands) = if slot.from == slot.start {
            (self.fetch(select, slot.start), operands)
        } else {
            let groups = self.groups(i, &operands);
            (self.select(select, slot.from, slot.from, Digits::Group), groups)
        };
        let args = std::iter::once(select).chain(operands).collect();
        self.out.signals[id.0].driver = Driver::Combinational { op: Select::default().into(), args };
    }

    /// The first of the two clocks of a multiplexer: the chosen operand of each group, registered.
    fn groups(&mut self, i: usize, operands: &[SignalId]) -> Vec<SignalId> {
        let block = Rc::clone(&self.block);
        let (node, slot) = (&block.nodes[i], self.schedule.slots[i]);
        let mut chosen = vec![];
        for (group, members) in operands.chunks(GROUP).enumerate() {
            let (op, args) = if members.iter().all(|o| *o == members[0]) {
                (None, vec![members[0]])
            } else {
                let index = self.select(node.args[0].0, slot.start, slot.start, Digits::InGroup);
                (Some(Select::default().into()), std::iter::once(index).chain(members.iter().copied()).collect())
            };
            let place = node.place.suffixed(&format!("group_{group}"));
            let id = self.push(place, node.ty, Driver::Register { op, args, enable: None, reset: None });
            self.describe(id, i, Some(slot.from));
            let (first, last) = (group * GROUP, group * GROUP + members.len() - 1);
            self.out.signals[id.0].comment = format!("operands {first} to {last}");
            chosen.push(id);
        }
        chosen
    }

    /// The operands of a multiplexer, each as it is in the clocks in which it is read.
    pub(super) fn mux_operands(&mut self, i: usize) -> Vec<SignalId> {
        let block = Rc::clone(&self.block);
        let Op::Mux { late } = &block.nodes[i].op else { return vec![] };
        let slot = self.schedule.slots[i];
        let lag_clocks = self.schedule.lag_clocks();
        let mut operands = vec![];
        for (k, is_late) in late.iter().enumerate() {
            let arg = block.nodes[i].args[1 + k].0;
            let Some((first, last)) = operand_phases(&block, i, k) else {
                // Never read: any operand will do.
                operands.push(None);
                continue;
            };
            let lag = if *is_late { lag_clocks } else { 0 };
            let (first, last) = (slot.start + first as i32 + lag, slot.start + last as i32 + lag);
            // The scheduler's own figure: an operand is direct exactly where the scheduler took it to be.
            let limit = slot.latest_operand(self.device, late.len(), *is_late);
            operands.push(Some(self.mux_operand(arg, slot.start + lag, first, last, limit)));
        }
        let any = operands.iter().flatten().next().copied().expect("some operand is read");
        operands.into_iter().map(|o| o.unwrap_or(any)).collect()
    }

    /// An operand of a multiplexer whose phase 0 is read in clock `start`, and it from clock `first` to clock `last`; values
    /// that arrive after `limit` nanoseconds are captured first.
    fn mux_operand(&mut self, arg: usize, start: i32, first: i32, last: i32, limit: f64) -> SignalId {
        let slot = self.schedule.slots[arg];
        if slot.from == i32::MIN || slot.until == i32::MAX {
            return self.fetch(arg, start);
        }
        if slot.ns <= limit + 1e-9 && slot.from <= first && last < slot.until {
            return self.base[arg].expect("operands come first");
        }
        self.hold(arg, last - self.interval() + 1, first)
    }

    /// A register with a value of each phase of the slot, the first in phase `at`, for a use that starts in `used`.
    pub(super) fn by_phase(
        &mut self,
        place: Place,
        ty: Type,
        at: i32,
        used: i32,
        value: impl Fn(usize) -> i128,
    ) -> SignalId {
        let interval = self.interval();
        let table = (0..interval).map(|p| value((p + 1 - at).rem_euclid(interval) as usize)).collect();
        let (op, args) = (Some(Lookup(table, ty).into()), vec![self.phase_port()]);
        let id = self.push(place, ty, Driver::Register { op, args, enable: None, reset: None });
        self.read.entry(id).or_default().insert(used);
        id
    }

    /// The values of a constant of each phase, that of phase 0 in `clock`, for a use that starts in `used`.
    pub(super) fn select(&mut self, i: usize, clock: i32, used: i32, digits: Digits) -> SignalId {
        let block = Rc::clone(&self.block);
        let at = clock.rem_euclid(self.interval());
        if let Some(id) = self.selects.get(&(i, at, digits)).copied() {
            self.read.entry(id).or_default().insert(used);
            return id;
        }
        let node = &block.nodes[i];
        let Op::Phase(values) = &node.op else { return self.base[i].expect("operands come first") };
        let group = GROUP as i128;
        let most = values.iter().flatten().max().copied().unwrap_or(0);
        let (part, ty) = match digits {
            Digits::All => ("", node.ty),
            Digits::InGroup => ("in_group_", Type::index(GROUP)),
            Digits::Group => ("group_", Type::index((most / group) as usize + 1)),
        };
        let value = |phase: usize| {
            let value = values[phase].unwrap_or(0);
            match digits {
                Digits::All => value,
                Digits::InGroup => value % group,
                Digits::Group => value / group,
            }
        };
        let id = self.by_phase(node.place.suffixed(&format!("{part}at_{at}")), ty, at, used, value);
        self.out.signals[id.0].comment.clone_from(&node.comment);
        self.selects.insert((i, at, digits), id);
        id
    }
}
