//! The slots of a data path: its phases, and which slots in flight hold something.

use efsat_hardware::graph::{Place, Step};
use efsat_hardware::netlist::lower::{HOLDS, PHASE};
use efsat_hardware::netlist::{Control, Wire};
use efsat_hardware::op::{Lookup, Type};

/// The slots of a data path that takes something new every `interval` clocks.
pub struct Slots<'m> {
    module: &'m Control,
    reset: Wire<'m>,
    interval: usize,
    /// Phase of the running slot; none if a slot has one clock.
    pub phase: Option<Wire<'m>>,
    /// Set in the last phase; none if a slot has one clock.
    pub last: Option<Wire<'m>>,
}

impl<'m> Slots<'m> {
    /// Counts the phases from reset on.
    pub fn new(module: &'m Control, reset: Wire<'m>, interval: usize) -> Self {
        let ty = Type::index(interval);
        let phase = (interval > 1).then(|| {
            let phase = module.register(PHASE, ty);
            let next = (0..interval as i128).map(|s| (s + 1) % interval as i128).collect();
            phase.loads(phase.apply(Lookup(next, ty), &[]), None, Some((reset, 0)));
            phase
        });
        let slots = Self { module, reset, interval, phase, last: None };
        Self { last: phase.map(|_| slots.in_phase("last_phase", interval - 1)), ..slots }
    }

    /// A flag set in a phase. It is read all over a design, so it comes from a register.
    pub fn in_phase(&self, name: &str, s: usize) -> Wire<'m> {
        let phase = self.phase.expect("a slot of several clocks has phases");
        let flag = self.module.register(name, Type::FLAG);
        let before = (s + self.interval - 1) % self.interval;
        flag.loads(phase.is(before as i128), None, Some((self.reset, 0)));
        flag.comment(&format!("set in phase {s}"))
    }

    /// Which slots in flight hold something, by their age: one flag per slot, shifted as slots begin.
    pub fn holds(&self, accept: Wire<'m>, latency: usize) -> Vec<Wire<'m>> {
        let mut before = accept;
        let flag = |age: usize| {
            let flag = self.module.register(Place::at(HOLDS, &[Step::Index(age)]), Type::FLAG);
            flag.loads(before, self.last, Some((self.reset, 0)));
            before = flag;
            flag
        };
        (0..=latency / self.interval).map(flag).collect()
    }

    /// A flag set where what the oldest slot holds leaves the data path; `name` is that of the flag of its phase.
    pub fn leaves(&self, holds: &[Wire<'m>], name: &str, latency: usize) -> Wire<'m> {
        let oldest = holds[holds.len() - 1];
        if self.phase.is_some() { oldest & self.in_phase(name, latency % self.interval) } else { oldest }
    }
}
