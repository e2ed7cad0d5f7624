//! What is claimed of an outward rounding: it contains the true number, and is within an ulp of the exact interval.

use super::claim::{Claim, number};
use efsat::design::rounding::Rounding;
use efsat::number::Upper;

/// Claims that the output `{out}_lo`, `{out}_hi` is the interval `{exact}_lo`, `{exact}_hi` rounded outward, where `when`
/// holds, and contains the number `{exact}_truth`.
///
/// With saturation the true number is given to be within its bound.
pub fn claim_rounded(claim: &mut Claim, when: &str, out: &str, exact: &str, way: Rounding, upper: Upper) {
    let (finer, coarser) = ((-way.drop).max(0), way.drop.max(0));
    let [truth, lo, hi] = ["truth", "lo", "hi"].map(|x| format!("({exact}_{x} <<< {finer})"));
    let bound = |end: &str| format!("({out}_{end} <<< {coarser})");
    if let Some((most, _)) = way.saturate {
        let most = number(most << coarser);
        claim.given(format!("!({when}) || (-{most} <= {truth} && {truth} <= {most})"));
    }
    let (floor, ceiling) = (bound("lo"), bound("hi"));
    claim.shown(format!("!({when}) || ({floor} <= {truth} && {truth} <= {ceiling})"));
    let ulp = 1i128 << coarser;
    // The implied rule may add a whole ulp, the exact ceiling less than one; nothing where nothing is dropped.
    let above = if upper == Upper::Implied && way.drop > 0 { ulp } else { ulp - 1 };
    claim.shown(format!("!({when}) || {lo} - {floor} <= {}", number(ulp - 1)));
    claim.shown(format!("!({when}) || {ceiling} - {hi} <= {}", number(above)));
}
