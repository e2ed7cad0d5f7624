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

impl Params {
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
