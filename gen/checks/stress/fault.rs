//! What a campaign finds, with everything needed to see it again.

use super::posed::Posed;
use super::truth::Answers;
use efsat_geometry::Points;
use efsat_geometry::exact::Exact;
use efsat_unit::pair::Verdict;
use std::fmt;

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A definite answer that is not the exact one.
    Wrong {
        /// What was answered.
        verdict: Verdict,
        /// The exact answer.
        truth: Exact,
    },
    /// The exact formulations contradict each other.
    Disagreement(Answers),
    /// The same numbers, or the same but for an exact scale or translation, and another answer.
    Unstable {
        /// What was answered.
        verdict: Verdict,
        /// The answer for the pair as the family made it.
        given: Verdict,
    },
}

/// The pair that was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// In one frame.
    Loose(Points),
    /// Under a pose.
    Posed(Posed),
}

/// The first fault of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub kind: Kind,
    /// Name of the family.
    pub family: &'static str,
    /// Number of the case in its family.
    pub index: u64,
    /// How the case was written, and on which other parameters it was asked, if any.
    pub variant: String,
    /// The numbers that were asked.
    pub asked: Asked,
    /// The command line that shows it again.
    pub replay: String,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wrong { verdict, truth } => write!(f, "wrong: {verdict}, exactly {truth}"),
            Self::Disagreement(answers) => write!(f, "disagreement: {answers}"),
            Self::Unstable { verdict, given } => write!(f, "unstable: {verdict}, as made {given}"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} ({} case {}, {})", self.kind, self.family, self.index, self.variant)?;
        let mut line = |name: &str, k: usize, x: &[f64; 3]| writeln!(f, "  {name}{k} {}", x.map(hexadecimal).join(" "));
        match &self.asked {
            Asked::Loose(points) => {
                for (k, x) in points.iter().enumerate() {
                    line(["a", "b"][k / 3], k % 3, x)?;
                }
            }
            Asked::Posed(Posed { a, b, motion }) => {
                for (name, rows) in [("a", &a[..]), ("b", b), ("m", &motion.m), ("t", &[motion.t])] {
                    for (k, x) in rows.iter().enumerate() {
                        line(name, k, x)?;
                    }
                }
            }
        }
        writeln!(f, "  {}", self.replay)
    }
}

/// A finite number exactly, as C's `%a` prints it.
fn hexadecimal(x: f64) -> String {
    let bits = x.to_bits();
    let sign = if x.is_sign_negative() { "-" } else { "" };
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = format!("{:013x}", bits & ((1 << 52) - 1));
    let fraction = fraction.trim_end_matches('0');
    let point = if fraction.is_empty() { "" } else { "." };
    let (whole, exponent) = match field {
        0 if fraction.is_empty() => (0, 0),
        0 => (0, -1022),
        _ => (1, field - 1023),
    };
    format!("{sign}0x{whole}{point}{fraction}p{exponent:+}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_numbers() {
        let cases = [
            (0.0, "0x0p+0"),
            (-0.0, "-0x0p+0"),
            (1.0, "0x1p+0"),
            (-0.15625, "-0x1.4p-3"),
            (0.1, "0x1.999999999999ap-4"),
            (f64::MAX, "0x1.fffffffffffffp+1023"),
            (5e-324, "0x0.0000000000001p-1022"),
        ];
        for (x, expected) in cases {
            assert_eq!(hexadecimal(x), expected);
        }
    }
}
