//! The shift of an axis: all bounds of its components go left by the leading zeros that they have in common before they
//! are rounded (section 5 of the contract). All that is compared on the axis carries the same power of two.

use super::interval::{Interval, Vector};
use super::rounding::{round_up, working};
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::number::Upper;
use efsat_hardware::op::Type;

/// The `exact` axis, shifted and rounded outward to the working width.
pub fn axis_shift<'l>(p: &Params, exact: Vector<'l>) -> Vector<'l> {
    let (n, positions) = (p.width, p.axis_positions());
    let doc = [
        "The exact axis brought to the working width. First it is shifted left by the leading zeros that its six bounds",
        "have in common once they are rounded without a shift: so rounding behind the shift overflows nothing.",
        &format!("The shift is at most {positions} places; {n} bits are dropped behind it."),
    ];
    entity!("axis_shift", &doc, (exact) => {
        let rounded = |x: &Interval<Sig<'l>>| Interval { lo: x.lo.floor(n as i32), hi: round_up(x.hi, n, p.upper) };
        let rounded = exact.map(|x| rounded(&x)).named("rounded");
        // A negative upper bound is nearer to zero than the lower one.
        let magnitudes = rounded.map(|x| Interval { lo: x.lo.magnitude().bits(n - 1), hi: x.hi.positive(n - 1) });
        let magnitudes = magnitudes.named("magnitudes");
        let word = magnitudes.signals().into_iter().reduce(|a, b| a | b).expect("an axis has bounds");
        let mut word = word.named("magnitude");
        // The bits that some shift keeps, and whether an upper bound has lost others.
        let kept = |x: Sig<'l>| x.floor((n - positions) as i32).at_point(None).bits(n + positions);
        let mut axis = exact.map(|x| x.each(|_, end| kept(end))).named("kept");
        let mut lost = exact.map(|x| x.hi.low(n - positions).any()).named("lost");
        for (i, step) in steps(positions).into_iter().enumerate() {
            let zero = (!word.floor((n - 1 - step) as i32).any()).named_at("zero", i + 1);
            let zero = zero.comment(&format!("the top {step} bits of the magnitude are zero"));
            word = zero.choose(word.shift_left(step), word).named_at("magnitude", i + 1);
            lost = axis.zip(lost, |x, lost| lost | (!zero & x.hi.low(step).any())).named_at("lost", i + 1);
            let shifted = |x: Sig<'l>| zero.choose(x.shift_left(step), x);
            let shifted = axis.map(|x| x.each(|_, end| shifted(end))).named_at("shifted", i + 1);
            axis = shifted.map(|x| x.each(|_, end| end.floor(step as i32)));
        }
        let most = (1i128 << (n - 1)) - 1;
        let up = |x: Sig<'l>, lost: Sig<'l>| match p.upper {
            Upper::Implied => x + x.block().constant(1, Type::FLAG),
            Upper::Sticky => x + lost,
        };
        let bounded = |x: Sig<'l>| x.assume(most, "axis-shift").resize(working(p));
        axis.zip(lost, |x, lost| Interval { lo: bounded(x.lo), hi: bounded(up(x.hi, lost)) }).named("l")
    })
}

/// Steps whose sums reach every shift up to `positions`, each no more than one above the sum of those behind it.
pub(super) fn steps(positions: u32) -> Vec<u32> {
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
                let step = |shift: u32, step: u32| shift + step * u32::from(zeros - shift.min(zeros) >= step);
                assert_eq!(
                    steps(positions).into_iter().fold(0, step),
                    zeros.min(positions),
                    "{zeros} zeros, {positions} positions"
                );
            }
        }
    }
}
