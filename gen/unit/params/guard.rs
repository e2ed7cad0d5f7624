//! The guard against words outside the declared ranges, and what a unit assumes of its input (docs/guard.md).

use super::options::Choice;
use super::{Method, Params, Transform, Truth};

/// Which units carry the guard (section 10 of the contract).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Guard {
    /// Those generated without a stage: no frame transform, a translation only, or no re-normalisation. The others answer
    /// a pair outside the declared ranges anyhow, definitely and wrongly too.
    LeftOut,
    /// All.
    Always,
}

impl Choice for Guard {
    const ALL: &'static [Self] = &[Self::LeftOut, Self::Always];

    fn name(self) -> &'static str {
        match self {
            Self::LeftOut => "left-out",
            Self::Always => "always",
        }
    }
}

/// What a number of a record is, by which its declared range is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A coordinate of a triangle.
    Coordinate,
    /// An entry of M.
    Entry,
    /// An entry of t.
    Translation,
    /// Not read by the unit, so that it only has to fit its word.
    Unread,
}

impl Quantity {
    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coordinate => "coordinate",
            Self::Entry => "entry of M",
            Self::Translation => "entry of t",
            Self::Unread => "number",
        }
    }
}

impl Params {
    /// The least and the greatest number of that kind that a host sends, as mantissas of [`Params::input`]; a number whose
    /// sticky bit is set is below the greatest. The unit makes no promise for others, unless it has a guard.
    pub fn declared(&self, quantity: Quantity) -> [i64; 2] {
        let word = self.input();
        let bound = match quantity {
            _ if self.method == Method::Exact && self.truth == Truth::Given => None,
            Quantity::Coordinate => Some(self.coordinate_bound()),
            Quantity::Entry => Some(self.one()),
            Quantity::Translation => Some(self.translation_bound()),
            Quantity::Unread => None,
        };
        bound.map_or([word.min(), word.max()], |bound| [-bound, bound]).map(|x| x as i64)
    }

    /// Whether the unit answers pairs outside the declared ranges itself, so that any word may come.
    pub fn guarded(&self) -> bool {
        self.has_guards() || self.method == Method::Exact
    }

    /// Whether a guard checks each number. The exact unit has one with the frame transform alone: else it checks the
    /// differences of numbers instead.
    pub fn has_guards(&self) -> bool {
        let complete = self.transform == Transform::On && self.renormalise;
        match self.method {
            Method::Exact => self.truth == Truth::Snapped,
            Method::Axes | Method::Determinants => self.guard == Guard::Always || !complete,
        }
    }

    /// What the unit assumes of its input, each line with the stage that makes it so; bounds are mantissas of
    /// [`Params::input`]. Other stages assume nothing: docs/guard.md says why.
    pub fn assumptions(&self) -> Vec<String> {
        if self.method == Method::Exact && self.truth == Truth::Given {
            let n = self.width;
            return vec![format!("input: any words; differences of coordinates beyond {n} bits are flagged")];
        }
        let mut lines = vec![format!("input: |coordinate| <= {} ulp", self.coordinate_bound())];
        let translation = format!("|t| <= {} ulp", self.translation_bound());
        lines.push(match self.transform {
            Transform::On => {
                format!("transform on: |m| <= {} ulp, {translation}; with bypass neither is read", self.one())
            }
            Transform::Translate => {
                format!("transform translate: M is the identity, {translation}; with bypass t is not read")
            }
            Transform::Off => "transform off: both triangles are in one frame".to_owned(),
        });
        if self.truth == Truth::Snapped {
            lines.push(format!("differences of coordinates beyond {} bits are flagged", self.width));
        }
        if !self.renormalise && self.transform == Transform::Off {
            lines.push("renormalise off: coordinates keep two ulps of the working format off its end".to_owned());
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_without_a_stage_are_guarded() {
        let guarded =
            |guard, transform, renormalise| Params { guard, transform, renormalise, ..Params::default() }.guarded();
        assert!(!guarded(Guard::LeftOut, Transform::On, true));
        assert!(guarded(Guard::Always, Transform::On, true));
        for transform in [Transform::Translate, Transform::Off] {
            assert!(guarded(Guard::LeftOut, transform, true));
        }
        assert!(guarded(Guard::LeftOut, Transform::On, false));
    }

    #[test]
    fn declared_ranges_are_those_of_the_assumptions() {
        let ranges = |p: &Params| {
            [Quantity::Coordinate, Quantity::Entry, Quantity::Translation, Quantity::Unread].map(|of| p.declared(of))
        };
        let (one, t, end) = (1 << 28, 1_073_741_816, 1 << 31);
        assert_eq!(ranges(&Params::default()), [[-one, one], [-one, one], [-t, t], [-end, end - 1]]);
        // Any word: the exact unit flags what does not fit itself.
        let exact = Params::of(Method::Exact);
        let end = 1 << (exact.transform_width - 1);
        assert_eq!(ranges(&exact), [[-end, end - 1]; 4]);
    }

    #[test]
    fn assumptions_name_their_stage() {
        let lines = Params { transform: Transform::Translate, ..Params::default() }.assumptions();
        assert_eq!(lines[0], "input: |coordinate| <= 268435456 ulp");
        let t = "transform translate: M is the identity, |t| <= 1073741816 ulp; with bypass t is not read";
        assert_eq!(lines[1..], [t]);
        assert_eq!(
            Params { transform: Transform::Off, renormalise: false, ..Params::default() }.assumptions().len(),
            3
        );
    }
}
