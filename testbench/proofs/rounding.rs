//! What is claimed of an outward rounding: it contains the true number, and is within an ulp of the exact interval.

use super::claim::{number, Claim};
use efsat::design::interval::Rounding;
use efsat::number::Upper;

/// The exact interval that is rounded, and a true number in it: expressions.
pub struct Exact<'a> {
    /// Lower bound.
    pub lo: &'a str,
    /// Upper bound.
    pub hi: &'a str,
    /// True number.
    pub truth: &'a str,
}

/// Claims of the output `{out}lo`, `{out}hi` that it is `exact` rounded outward, where `when` holds.
///
/// With a clamp the true number is given to be within the clamp's bound.
pub fn claim_rounded(claim: &mut Claim, when: &str, out: &str, exact: &Exact, way: Rounding, upper: Upper) {
    let (finer, coarser) = ((-way.drop).max(0), way.drop.max(0));
    let Exact { lo, hi, truth } = exact;
    let truth = format!("(({truth}) <<< {finer})");
    let bound = |end: &str| format!("({out}{end} <<< {coarser})");
    if let Some((most, _)) = way.clamp {
        let most = format!("({} <<< {coarser})", number(most));
        claim.given(format!("!({when}) || (-{most} <= {truth} && {truth} <= {most})"));
    }
    let (floor, ceiling) = (bound("lo"), bound("hi"));
    claim.shown(format!("!({when}) || ({floor} <= {truth} && {truth} <= {ceiling})"));
    let ulp = 1i128 << coarser;
    // The implied rule may add a whole ulp, the exact ceiling less than one; nothing where nothing is dropped.
    let above = if upper == Upper::Implied && way.drop > 0 { ulp } else { ulp - 1 };
    claim.shown(format!("!({when}) || ((({lo}) <<< {finer}) - {floor} <= {})", number(ulp - 1)));
    claim.shown(format!("!({when}) || ({ceiling} - (({hi}) <<< {finer}) <= {})", number(above)));
}
