//! The shift of an axis: all bounds of its components go left by the leading zeros that they have in common, before they
//! are rounded (section 5 of the contract). All that is compared on the axis carries the same power of two.

use super::interval::{Interval, Vector};
use super::rounding::{Rounding, Roundings, round_up, working};
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::op::Select;

/// The exact axis `l`, shifted and rounded outward to the working width; `roundings` are those of shift 0.
pub fn axis_shift<'l>(p: &Params, l: Vector<'l>, roundings: &Roundings<'l>) -> Vector<'l> {
    let doc = [
        "The exact axis shifted left by the leading zeros that its six bounds have in common, then rounded outward. They",
        "are counted once the bounds are rounded as for no shift, so that rounding behind the shift overflows nothing.",
    ];
    // One barrel shifter serves all kinds of axes: in front of it they are brought to one place.
    let drop = roundings.ways().iter().map(|way| way.drop).max().expect("at least one kind of axis");
    let most = (1i128 << (p.width - 1)) - 1;
    let (rounding, positions) = (roundings.select, p.axis_positions());
    entity!("axis_shift", &doc, (l, rounding) => {
        let placed = |x: Sig<'l>| {
            let way = |way: &Rounding| {
                let x = match way.saturate {
                    Some((bound, lemma)) => x.saturate(bound << way.drop, lemma),
                    None => x,
                };
                x.floor(way.drop - drop)
            };
            let ways: Vec<Sig<'l>> = roundings.ways().iter().map(way).collect();
            match rounding {
                Some(select) => select.apply(Select::default(), &ways),
                None => ways[0],
            }
        };
        let mut l = l.map(|x| x.each(|_, end| placed(end))).named("placed");
        let rounded = l.map(|x| Interval { lo: x.lo.floor(drop), hi: round_up(x.hi, drop as u32, p.upper) }).named("rounded");
        let magnitude = |x: &Interval<Sig<'l>>| {
            let of = |x: Sig<'l>| x.magnitude().bits(p.width - 1);
            of(x.lo) | of(x.hi)
        };
        let mut word = (magnitude(&rounded[0]) | magnitude(&rounded[1]) | magnitude(&rounded[2])).named("magnitude");
        for step in steps(positions) {
            let zero = !word.floor((p.width - 1 - step) as i32).any();
            let zero = zero.named(&format!("zero_{step}")).comment(&format!("the top {step} bits are zero"));
            word = zero.choose(word.shift_left(step), word).named(&format!("magnitude_{step}"));
            // What is shifted out is zero where the shift is taken.
            let shifted = |x: Sig<'l>| zero.choose(x.shift_left(step), x).assume(most << drop, "axis-shift");
            l = l.map(|x| x.each(|_, end| shifted(end))).named(&format!("shifted_{step}"));
        }
        let hi = |x: Sig<'l>| round_up(x, drop as u32, p.upper);
        let bounded = |x: Sig<'l>| x.assume(most, "axis-shift").resize(working(p));
        l.map(|x| Interval { lo: bounded(x.lo.floor(drop)), hi: bounded(hi(x.hi)) }).named("l")
    })
}

/// Steps whose sums reach every shift up to `positions`, each no more than one above the sum of those behind it.
fn steps(positions: u32) -> Vec<u32> {
    let mut rest = positions;
    let mut all = vec![];
    while rest > 0 {
        let step = rest.div_ceil(2);
        all.push(step);
        rest -= step;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_reach_every_shift() {
        for positions in 0..=30 {
            // As the hardware takes them: a step wherever there are so many zeros left.
            for zeros in 0..=40u32 {
                let shift = steps(positions).into_iter().fold(0, |shift, step| shift + step * u32::from(zeros - shift.min(zeros) >= step));
                assert_eq!(shift, zeros.min(positions), "{zeros} zeros, {positions} positions");
            }
        }
    }
}
