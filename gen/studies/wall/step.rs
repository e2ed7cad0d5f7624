//! How far the moved vertex goes from one cell to the next.

use super::{Contact, WallError};
use efsat_unit::params::Params;
use std::fmt;
use std::str::FromStr;

/// Binary exponents of the steps for which the contacts are made: no coordinate is rounded and none leaves the contact.
pub(super) const FINEST: i32 = -53;
pub(super) const COARSEST: i32 = -7;

/// The distance of neighbouring cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The least step that the axis test sees: one ulp of the coordinates after re-normalisation, on the coarsest of
    /// the three coordinate axes, or one ulp of the input format if that is greater.
    Working,
    /// One ulp of the input format, after the host's scaling.
    Input,
    /// One ulp of the greatest binary64 coordinate of the moved vertex.
    Binary64,
    /// Two to this power.
    Power(i32),
}

impl Step {
    /// The binary exponent of the step around a contact.
    pub fn exponent(self, contact: &Contact, params: &Params) -> i32 {
        let points = contact.points();
        match self {
            Self::Power(exponent) => exponent,
            Self::Binary64 => {
                let greatest = points[contact.moved].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                above(greatest) - f64::MANTISSA_DIGITS as i32
            }
            Self::Input => host_scale(&points) - params.input().fraction,
            Self::Working => {
                let fraction = params.formats().coordinate_a.format.fraction;
                let scale = if params.renormalise { pair_scale(&points) } else { host_scale(&points) };
                (scale - fraction).max(Self::Input.exponent(contact, params))
            }
        }
    }
}

/// The greatest of the three powers of two that re-normalisation divides by (contract section 4): above all distances
/// from V0.
fn pair_scale(points: &[[f64; 3]; 6]) -> i32 {
    let reach = |x: &[f64; 3]| (0..3).map(|i| (x[i] - points[0][i]).abs()).fold(0.0, f64::max);
    above(points.iter().map(reach).fold(0.0, f64::max))
}

/// The power of two that the host divides a loose pair by (contract section 2): the least that half the longest side
/// of the joint box does not exceed.
fn host_scale(points: &[[f64; 3]; 6]) -> i32 {
    let side = |i: usize| {
        let along = points.map(|x| x[i]);
        along.iter().copied().fold(f64::MIN, f64::max) - along.iter().copied().fold(f64::MAX, f64::min)
    };
    let half = [0, 1, 2].map(side).into_iter().fold(0.0, f64::max) / 2.0;
    let power = above(half);
    power - i32::from(half == f64::from(power - 1).exp2())
}

/// The least p with x < 2^p, for a normal positive number.
fn above(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1022
}

impl FromStr for Step {
    type Err = WallError;

    fn from_str(text: &str) -> Result<Self, WallError> {
        match text {
            "working" => Ok(Self::Working),
            "input" => Ok(Self::Input),
            "binary64" => Ok(Self::Binary64),
            _ => {
                let exponent = text.strip_prefix("2^").and_then(|exponent| exponent.parse().ok());
                exponent.filter(|e| (FINEST..=COARSEST).contains(e)).map(Self::Power).ok_or(WallError::UnknownStep)
            }
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Working => f.write_str("working"),
            Self::Input => f.write_str("input"),
            Self::Binary64 => f.write_str("binary64"),
            Self::Power(exponent) => write!(f, "2^{exponent}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::CONTACTS;

    #[test]
    fn words_and_powers() {
        for step in ["working", "input", "binary64", "2^-7", "2^-53"] {
            assert_eq!(step.parse::<Step>().unwrap().to_string(), step);
        }
        for step in ["", "ulp", "2^-6", "2^-54", "2^", "-12", "2^1.5"] {
            assert_eq!(step.parse::<Step>(), Err(WallError::UnknownStep), "{step}");
        }
    }

    #[test]
    fn exponents_of_the_first_contact() {
        let params = Params::default();
        let at = |step: Step| step.exponent(&CONTACTS[0], &params);
        // Reach 12 from V0: 2^4 over 16 fraction bits. Half the longest side 9.5: 2^4 over 28 fraction bits.
        assert_eq!([Step::Working, Step::Input, Step::Binary64].map(at), [4 - 16, 4 - 28, -53]);
        // Wider than the input: its ulp is the greater one.
        let wide = Params { width: 32, ..Params::default() };
        assert_eq!(Step::Working.exponent(&CONTACTS[0], &wide), 4 - 28);
        let plain = Params { renormalise: false, ..Params::default() };
        assert_eq!(Step::Working.exponent(&CONTACTS[0], &plain), 4 - 14);
        assert_eq!([0.5, 0.75, 1.0, 12.0].map(above), [0, 0, 1, 4]);
    }
}
