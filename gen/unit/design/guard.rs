//! The guard of a unit (section 10 of the contract): every number is checked where few of them pass, and one outside its
//! declared range is replaced, so that nothing behind sees a number for which its formats are not proven.
//!
//! Units that are shared over phases (lanes, transform rows) have one guard for each number that enters them, behind the
//! operand multiplexer; numbers that enter all at once have one each.

use super::number::Number;
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Sig, Signals, Top};
use efsat_hardware::op::Type;
use std::cell::RefCell;

/// A number within `bound`, whatever the word, and whether it was outside.
///
/// With `2^d` the greatest power of two that divides the bound, the number is `h 2^d + low`: it is outside where `h` is
/// beyond `bound / 2^d`, or equal to it with something below.
pub fn guard<'l>(name: &str, number: Number<Sig<'l>>, bound: i128) -> (Number<Sig<'l>>, Sig<'l>) {
    let doc = [
        "The guard of an input number (section 10 of the contract): outside its declared range it is flagged, and its low",
        "bits alone go on, a number inside. Whatever the word is, all formats behind hold what is computed from it.",
    ];
    let (lo, outside) = entity!(name, &doc, (number) => {
        let word = number.lo;
        let cut = bound.trailing_zeros();
        let most = bound >> cut;
        let (high, low) = (word.floor(cut as i32).named("high"), word.low(cut));
        let more = number.sticky.map_or(low.any(), |sticky| low.any() | sticky);
        let above = (high.equals(high.like(most)) & more).named("above");
        let above = above.comment(&format!("word > {bound}, by less than {}", 1i128 << cut));
        let below = high.equals(high.like(-most - 1)).named("below");
        let below = below.comment(&format!("word < -{bound}, by at most {}", 1i128 << cut));
        let mut outside = above | below;
        // `most` is q 2^k - 1, so what is left is a matter of the bits above k.
        let again = (most + 1).trailing_zeros();
        let reach = (most + 1) >> again;
        let top = high.ty().bits - again;
        if reach < 1 << (top - 1) {
            let top = high.floor(again as i32).named("top");
            outside = outside | beyond(top, reach).named("far").comment("farther outside than that");
        }
        let outside = outside.named("outside");
        let kept = word.low(bound.ilog2()).resize(word.ty());
        let lo = outside.choose(kept, word).named("passed").assume(bound, "guard");
        (lo.comment(&format!("within +-{bound} whatever the word is: lemma guard")).named("passed"), outside)
    });
    (Number { lo, ..number }, outside)
}

/// Flag: `top` is not in [-reach, reach - 1], by the shorter list of values.
fn beyond(top: Sig<'_>, reach: i128) -> Sig<'_> {
    let (least, greatest) = top.ty().limits();
    let (inner, outer): (Vec<i128>, Vec<i128>) = (least..=greatest).partition(|v| (-reach..reach).contains(v));
    let short = if outer.len() <= inner.len() { &outer } else { &inner };
    let flags = short.iter().map(|value| top.equals(top.like(*value)));
    let listed = flags.reduce(|a, b| a | b).expect("some value is beyond");
    if outer.len() <= inner.len() { listed } else { !listed }
}

/// The guards of a data path in the making.
pub(super) struct Guards<'l, 'p> {
    u: Top<'l>,
    p: &'p Params,
    /// What they say in each phase, with the phases that count: in idle ones the flags have no meaning.
    of_phases: RefCell<Vec<(Vec<bool>, Sig<'l>)>>,
    /// What they say once per pair.
    of_pair: RefCell<Vec<Sig<'l>>>,
}

impl<'l, 'p> Guards<'l, 'p> {
    pub fn new(u: Top<'l>, p: &'p Params) -> Self {
        Self { u, p, of_phases: RefCell::default(), of_pair: RefCell::default() }
    }

    /// The numbers behind a guard each, in a unit that has them; else as they are. Of numbers that are others in every
    /// phase, those in busy phases count. They are named, with a number where there
    /// are several of that name.
    pub fn guarded<const N: usize>(
        &self,
        numbers: [Number<Sig<'l>>; N],
        bound: i128,
        busy: &[bool],
        (name, at): (&str, Option<usize>),
    ) -> [Number<Sig<'l>>; N] {
        let (passed, flags) = self.behind(numbers, bound, (name, at));
        for flag in flags {
            if busy.is_empty() {
                self.of_pair.borrow_mut().push(flag);
            } else {
                self.of_phases.borrow_mut().push((busy.to_vec(), flag));
            }
        }
        passed
    }

    /// The same of numbers that count with a flag alone, as nothing of them is used without it.
    pub fn guarded_if<const N: usize>(
        &self,
        used: Sig<'l>,
        numbers: [Number<Sig<'l>>; N],
        bound: i128,
        (name, k): (&str, usize),
    ) -> [Number<Sig<'l>>; N] {
        let (passed, flags) = self.behind(numbers, bound, (name, Some(k)));
        if !flags.is_empty() {
            self.found(&[(any(&flags) & used).named_at(&format!("{name}_used_outside"), k)]);
        }
        passed
    }

    /// The numbers behind guards, and what those say, which is nothing in a unit without them.
    fn behind<const N: usize>(
        &self,
        numbers: [Number<Sig<'l>>; N],
        bound: i128,
        (name, at): (&str, Option<usize>),
    ) -> ([Number<Sig<'l>>; N], Vec<Sig<'l>>) {
        if !self.p.has_guards() {
            return (numbers, vec![]);
        }
        let entity = if bound == self.p.coordinate_bound() { "guard_coordinate" } else { "guard_translation" };
        let guarded = numbers.map(|number| guard(entity, number, bound));
        let named = |signals: [Sig<'l>; N], what: &str| match at {
            Some(k) => signals.named_at(&format!("{name}_{what}"), k),
            None => signals.named(&format!("{name}_{what}")),
        };
        let flags = named(guarded.map(|g| g.1), "outside").to_vec();
        named(guarded.map(|g| g.0.lo), "inside");
        (guarded.map(|g| g.0), flags)
    }

    /// More flags that say once per pair that it is outside.
    pub fn found(&self, flags: &[Sig<'l>]) {
        self.of_pair.borrow_mut().extend(flags);
    }

    /// Whether some number of the pair or its pose is outside, held for the pair; none in a unit without guards.
    pub fn outside(&self) -> Option<Sig<'l>> {
        let mut all = self.of_pair.borrow().clone();
        // The flags that count in the same phases, clear in all others.
        let mut groups: Vec<(Vec<bool>, Vec<Sig<'l>>)> = vec![];
        for (busy, flag) in self.of_phases.borrow().iter() {
            match groups.iter_mut().find(|(of, _)| of == busy) {
                Some((_, group)) => group.push(*flag),
                None => groups.push((busy.clone(), vec![*flag])),
            }
        }
        let interval = self.p.interval();
        let mut found = vec![];
        for (busy, flags) in groups {
            let any = any(&flags);
            let counts = Phases::new(interval, |s| Some(i128::from(busy[s])));
            found.push(if busy.contains(&false) { any & counts.constant(self.u, Type::FLAG) } else { any });
        }
        if !found.is_empty() {
            let found = any(&found).named("outside_found");
            let first = Phases::new(interval, |s| Some(i128::from(s == 0))).constant(self.u, Type::FLAG);
            let all_phases = if interval > 1 { found.or_over_phases(first).named("outside_so_far") } else { found };
            all.push(all_phases.capture(interval - 1, false).named("outside_in_phases"));
        }
        let comment = "a number of the pair or its pose is outside its declared range";
        let flags = |all: &[Sig<'l>]| match all {
            [one] => *one,
            _ => all[0].below(&all[1..]).named("outside_flags").any(),
        };
        (!all.is_empty()).then(|| flags(&all).named("outside").comment(comment))
    }
}

/// Flag: some of the flags is set.
pub fn any<'l>(flags: &[Sig<'l>]) -> Sig<'l> {
    if let [one] = flags { *one } else { flags[0].below(&flags[1..]).any() }
}
