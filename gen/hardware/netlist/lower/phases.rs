//! Flags of phases and of pairs: when captures load, and when what selects moves on.

use super::Lowered;
use crate::graph::{Place, Step};
use crate::netlist::module::{Driver, SignalId};
use crate::op::{And, Comb, Constant, Equal, Or, Type};
use std::collections::BTreeSet;

impl Lowered<'_> {
    /// A flag set in the clocks congruent to `clock` while a pair is in the data path; none if that is always.
    pub(super) fn strobe(&mut self, clock: i32) -> Option<SignalId> {
        self.phase?;
        let interval = self.interval();
        if self.strobes.is_empty() {
            let any = self.holds.clone().into_iter().reduce(|any, holds| self.combined(None, Or, vec![any, holds]));
            // In the last phase it is not known yet whether the next slot holds a pair.
            let last = self.in_phase(-1);
            let in_flight = self.combined(Some("in_flight".to_owned()), Or, any.into_iter().chain([last]).collect());
            self.out.signals[in_flight.0].comment =
                "a pair is in the data path, or may be in the next clock".to_owned();
            // One flag per phase, whether it is read or not, so that they are one vector.
            for at in 0..interval {
                let before = self.phase_is(None, at - 1);
                let args = vec![before, in_flight];
                let driver = Driver::Register { op: Some(And.into()), args, enable: None, reset: None };
                let id = self.push(Place::at("strobe", &[Step::Index(at as usize)]), Type::FLAG, driver);
                self.out.signals[id.0].comment = "one flag per phase".to_owned();
                self.strobes.push(id);
            }
        }
        Some(self.strobes[clock.rem_euclid(interval) as usize])
    }

    /// What selects rests where no pair is: it loads only where the use of a pair goes on in the next clock.
    pub(super) fn rest(&mut self) {
        let late = self.schedule.lag_clocks();
        for (select, uses) in std::mem::take(&mut self.read) {
            if uses.first().is_some_and(|clock| *clock < 0) {
                // What is constant but for this is there at any time.
                continue;
            }
            // Late phases are those of a pair of an earlier slot.
            let clocks: BTreeSet<i32> = uses.iter().flat_map(|clock| [*clock, clock + late]).collect();
            // Behind the latency nothing of a pair is read.
            let in_flight = |clock: &i32| (clock - 2).div_euclid(self.interval()) < self.holds.len() as i32;
            let clocks: Vec<i32> = clocks.into_iter().filter(in_flight).collect();
            let any = self.any_busy(&clocks);
            if let Driver::Register { enable, .. } = &mut self.out.signals[select.0].driver {
                *enable = any;
            }
        }
    }

    /// A flag set from the clock before a clock of a pair on, for a slot.
    fn busy(&mut self, clock: i32) -> SignalId {
        if let Some(known) = self.busy.get(&clock) {
            return *known;
        }
        let flag = match clock {
            0 => {
                let last = self.in_phase(-1);
                let args = vec![self.holds[0], last];
                let either = self.combined(Some("busy_0".to_owned()), Or, args);
                self.out.signals[either.0].comment = "set in the clock before a pair, and in clock 0 of one".to_owned();
                either
            }
            1 => self.holds[0],
            _ => {
                let age = (clock - 2) / self.interval();
                let begins = self.in_phase(clock - 2);
                let place = Place::new(format!("busy_{clock}"));
                let flag = self.register(place, Type::FLAG, self.holds[age as usize], Some(begins));
                let last = clock + self.interval() - 2;
                self.out.signals[flag.0].comment = format!("set in clocks {} to {last} of a pair", clock - 1);
                flag
            }
        };
        self.busy.insert(clock, flag);
        flag
    }

    /// A flag set in the clocks congruent to `clock`, with or without a pair.
    fn in_phase(&mut self, clock: i32) -> SignalId {
        let name = format!("in_phase_{}", clock.rem_euclid(self.interval()));
        let known = self.out.signals.iter().position(|signal| signal.named && signal.name() == name);
        known.map_or_else(|| self.phase_is(Some(name), clock), SignalId)
    }

    /// Whether the phase is that of a clock.
    fn phase_is(&mut self, name: Option<String>, clock: i32) -> SignalId {
        let phase = self.phase_port();
        let (number, ty) = (clock.rem_euclid(self.interval()), self.out.signal(phase).ty);
        let constant = Driver::Combinational { op: Constant(number.into(), ty).into(), args: vec![] };
        let number = self.push(Place::new("phase_number"), ty, constant);
        self.combined(name, Equal, vec![phase, number])
    }

    /// A flag set where one of those of some clocks is: it has a name of its own where it is more than part of another.
    fn any_busy(&mut self, clocks: &[i32]) -> Option<SignalId> {
        let (last, before) = clocks.split_last()?;
        let any = self.any_busy(before);
        let flag = self.busy(*last);
        let Some(any) = any else { return Some(flag) };
        if let Some(known) = self.either.get(&[any, flag]) {
            return Some(*known);
        }
        let name = format!("busy_{}_to_{last}", clocks[0]);
        let taken = |name: &String| self.out.signals.iter().any(|signal| signal.place.base == *name);
        let numbered = (2..).map(|n| format!("{name}_{n}"));
        let name = std::iter::once(name.clone()).chain(numbered).find(|name| !taken(name));
        let either = self.combined(name, Or, vec![any, flag]);
        let all: Vec<String> = clocks.iter().map(ToString::to_string).collect();
        let signal = &mut self.out.signals[either.0];
        signal.named = false;
        signal.comment = format!("a pair comes to clock {} or is in it", all.join(", "));
        self.either.insert([any, flag], either);
        Some(either)
    }

    fn combined(&mut self, name: Option<String>, op: impl Into<Comb>, args: Vec<SignalId>) -> SignalId {
        let named = name.is_some();
        let driver = Driver::Combinational { op: op.into(), args };
        let id = self.push(Place::new(name.unwrap_or("flag".to_owned())), Type::FLAG, driver);
        self.out.signals[id.0].named = named;
        id
    }

    pub(super) fn phase_port(&self) -> SignalId {
        self.phase.expect("a block with phases has the port")
    }
}
