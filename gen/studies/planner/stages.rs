//! The optional stages of a unit.

use efsat_unit::host::settings::Effect;
use efsat_unit::params::{Axes, Method, Params, Transform, Upper};

/// Which optional stages a unit has; everything else is in its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stages {
    /// The change of frame: whole, a translation, or none.
    pub transform: Transform,
    /// Each pair moved to the origin and scaled up.
    pub renormalise: bool,
    /// 17 axes instead of 11.
    pub in_plane_axes: bool,
    /// Upper bounds by sticky bits instead of the next grid point.
    pub exact_ceiling: bool,
}

impl Stages {
    /// Every stage there is.
    pub const ALL: Self =
        Self { transform: Transform::On, renormalise: true, in_plane_axes: true, exact_ceiling: true };

    /// The stages that parameters ask for.
    pub fn of(params: &Params) -> Self {
        Self {
            transform: params.transform,
            renormalise: params.renormalise,
            in_plane_axes: params.axes == Axes::Seventeen,
            exact_ceiling: params.upper == Upper::Sticky,
        }
    }

    /// The stages that a unit of a method may have or not, in the order in which they are tried.
    pub fn optional(method: Method) -> &'static [Effect] {
        match method {
            Method::Axes => &[Effect::Transform, Effect::Renormalise, Effect::InPlaneAxes, Effect::ExactCeiling],
            Method::Determinants | Method::Exact => &[Effect::Transform],
        }
    }

    /// Parameters with these stages, as far as they are optional. There are never more axis units than axes.
    pub fn params(self, base: &Params) -> Params {
        if base.method != Method::Axes {
            return Params { transform: self.transform, ..base.clone() };
        }
        let axes = if self.in_plane_axes { Axes::Seventeen } else { Axes::Eleven };
        Params {
            transform: self.transform,
            renormalise: self.renormalise,
            axes,
            axes_per_clock: base.axes_per_clock.min(axes.count()),
            upper: if self.exact_ceiling { Upper::Sticky } else { Upper::Implied },
            ..base.clone()
        }
    }

    /// Whether a stage of the unit is there, whole or in part.
    pub fn has(self, effect: Effect) -> bool {
        match effect {
            Effect::Transform => self.transform != Transform::Off,
            Effect::Renormalise => self.renormalise,
            Effect::InPlaneAxes => self.in_plane_axes,
            Effect::ExactCeiling => self.exact_ceiling,
            Effect::BroadPhase | Effect::Hierarchy | Effect::Degenerate => false,
        }
    }

    /// With a stage of the unit as it is in `other`.
    pub fn with(self, effect: Effect, other: Self) -> Self {
        match effect {
            Effect::Transform => Self { transform: other.transform, ..self },
            Effect::Renormalise => Self { renormalise: other.renormalise, ..self },
            Effect::InPlaneAxes => Self { in_plane_axes: other.in_plane_axes, ..self },
            Effect::ExactCeiling => Self { exact_ceiling: other.exact_ceiling, ..self },
            Effect::BroadPhase | Effect::Hierarchy | Effect::Degenerate => self,
        }
    }

    /// With a stage of the unit put in as a whole, or left out.
    pub fn set(self, effect: Effect, there: bool) -> Self {
        self.with(effect, if there { Self::ALL } else { Self::NONE })
    }

    /// No optional stage.
    pub const NONE: Self =
        Self { transform: Transform::Off, renormalise: false, in_plane_axes: false, exact_ceiling: false };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_and_parameters_are_two_ways_to_say_the_same() {
        for transform in [Transform::On, Transform::Translate, Transform::Off] {
            for bits in 0..8 {
                let [renormalise, in_plane_axes, exact_ceiling] = [1, 2, 4].map(|bit| bits & bit != 0);
                let stages = Stages { transform, renormalise, in_plane_axes, exact_ceiling };
                let params = stages.params(&Params { axes_per_clock: 17, width: 20, ..Params::default() });
                assert_eq!((Stages::of(&params), params.width), (stages, 20));
                assert!(params.validate().is_ok(), "{params:?}");
                let there = Effect::ALL.map(|effect| stages.has(effect));
                let part = transform != Transform::Off;
                assert_eq!(there, [false, false, false, part, renormalise, in_plane_axes, exact_ceiling]);
                for effect in Effect::ALL.into_iter().filter(|effect| effect.is_hardware()) {
                    assert!(stages.set(effect, true).has(effect) && !stages.set(effect, false).has(effect));
                }
            }
        }
    }
}
