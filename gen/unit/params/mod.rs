//! One validated parameter set, and the table of number formats that follows from it.
//!
//! Everything downstream (golden model, graph builders, host side) reads the same [`Params`] and the same
//! [`Formats`]; nothing else decides a width.

mod formats;
mod guard;
mod method;
pub mod options;

pub use efsat_hardware::number::Upper;
pub use formats::{AxisKind, Clamp, FormatRow, Formats};
pub use guard::{Guard, Quantity};
pub use method::{
    BELOW_GRID, Bound, CLOCKS_PER_PAIR, EXACT_CLOCKS, ErrorLevels, ExactClocks, LEVELS, Method, SPAN, Truth,
};
pub use options::Params;

use std::ops::RangeInclusive;

/// Which separating axes are tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axes {
    /// n_A, n_B and the nine edge cross products: the paper's set.
    Eleven,
    /// The eleven and the six in-plane edge normals n_A x e_Ak, n_B x e_Bk, which separate coplanar triangles.
    Seventeen,
}

impl Axes {
    /// The number of axes: 11 or 17.
    pub const fn count(self) -> usize {
        match self {
            Self::Eleven => 11,
            Self::Seventeen => 17,
        }
    }
}

/// What is done with duplicate projections (section 5 of the contract, the paper's future work).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Projections {
    /// Compute all six projections of every axis and use them as they come: the paper.
    All,
    /// Compute each group of equal projections once.
    Skip,
    /// Compute all and intersect the enclosures of equal projections.
    Intersect,
}

/// How wide the projections are that the comparators see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProjectionWidth {
    /// Rounded outward to the working width: the paper.
    Rounded,
    /// So many bits more than the working width: both bounds are rounded down, which comparisons allow.
    Plus(u32),
    /// Exact.
    Full,
}

/// How triangle B reaches triangle A's frame of reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transform {
    /// B = M * B~ + t.
    On,
    /// B = B~ + t.
    Translate,
    /// B = B~: both triangles come in one frame.
    Off,
}

/// A parameter outside its range: which option, what was given, what is legal.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("--{option} {found}: {legal}")]
pub struct ParamError {
    /// Option name without dashes.
    pub option: &'static str,
    /// The value found.
    pub found: String,
    /// What is legal, in words.
    pub legal: String,
}

impl Params {
    /// Checks every range and every relation between options.
    ///
    /// # Errors
    /// The first option outside its range, with the legal range.
    pub fn validate(&self) -> Result<(), ParamError> {
        let (n, k) = (self.width, self.int_bits);
        let range = |option, found: u32, legal: RangeInclusive<u32>, why: &str| {
            if legal.contains(&found) {
                return Ok(());
            }
            let legal = format!("expected {} to {}{why}", legal.start(), legal.end());
            Err(ParamError { option, found: found.to_string(), legal })
        };
        range("width", n, options::WIDTH, "")?;
        let (least, most) = options::INT_BITS.into_inner();
        let why = format!(" ({least} to {most}, at most width - 2 = {})", n - 2);
        range("int-bits", k, least..=most.min(n - 2), &why)?;
        let widths = n..=options::TRANSFORM_WIDTH;
        range("transform-width", self.transform_width, widths, &format!(" (at least --width {n})"))?;
        self.validate_method()?;
        range("axis-shift", self.axis_shift, options::AXIS_SHIFT, "")?;
        if let ProjectionWidth::Plus(bits) = self.projection_width {
            range("projection-width", bits, options::PROJECTION_PLUS, "")?;
        }
        range("frequency", self.frequency, options::FREQUENCY, " MHz")?;
        range("tag-width", self.tag_width, options::TAG_WIDTH, "")
    }

    /// Checks that the method has all of some options, whatever their values are.
    ///
    /// # Errors
    /// If it has not: the first such option.
    pub fn has(&self, options: impl IntoIterator<Item = (&'static str, String)>) -> Result<(), ParamError> {
        let foreign = |(option, _): &(&'static str, String)| {
            let row = Self::OPTIONS.iter().find(|row| row.name == *option);
            row.is_some_and(|row| !row.of.contains(&self.method))
        };
        match options.into_iter().find(foreign) {
            Some((option, found)) => {
                let legal = format!("expected --method {}, which has this option", methods_with(option));
                Err(ParamError { option, found, legal })
            }
            None => Ok(()),
        }
    }

    /// Checks the options that not every method has.
    fn validate_method(&self) -> Result<(), ParamError> {
        self.has(self.differences(&Self::of(self.method)))?;
        let wrong = match (self.truth, self.transform) {
            (Truth::Given, Transform::On) if self.method == Method::Exact => {
                Some("off or translate with --method exact, which rounds nothing, unless with --truth snapped")
            }
            (Truth::Snapped, Transform::Off | Transform::Translate) => Some("on with --truth snapped"),
            _ => None,
        };
        if let Some(expected) = wrong {
            let (found, legal) = (options::Choice::name(self.transform).to_owned(), format!("expected {expected}"));
            return Err(ParamError { option: "transform", found, legal });
        }
        if let Some(clocks) = self.exact_clocks
            && !EXACT_CLOCKS.contains(&clocks)
        {
            let legal = format!("expected {} to {}, or off", EXACT_CLOCKS.start(), EXACT_CLOCKS.end());
            return Err(ParamError { option: "exact-clocks", found: clocks.to_string(), legal });
        }
        let axes = self.axes.count();
        if !(1..=axes).contains(&self.axes_per_clock) {
            let legal = format!("expected 1 to {axes} (--axes {axes})");
            return Err(ParamError { option: "axes-per-clock", found: self.axes_per_clock.to_string(), legal });
        }
        let listed = [
            ("clocks-per-pair", self.clocks_per_pair, CLOCKS_PER_PAIR),
            ("span", self.span, SPAN),
            ("levels", self.levels, LEVELS),
        ];
        match listed.into_iter().find(|(_, found, list)| !list.contains(found)) {
            None => Ok(()),
            Some((option, found, list)) => {
                let legal = list.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
                Err(ParamError { option, found: found.to_string(), legal: format!("expected one of {legal}") })
            }
        }
    }

    /// The first stage of a cascade: a determinant unit whose input error is nothing, as all that it drops of the
    /// differences at least are places below the grid (docs/cascade.md).
    pub fn first_stage(&self) -> Option<Self> {
        self.exact_clocks.map(|_| Self {
            clocks_per_pair: self.clocks_per_pair,
            transform: Transform::Off,
            levels: 0,
            ..Self::of(Method::Determinants)
        })
    }

    /// Initiation interval in clocks: one pair every ceil(axes / axes per clock), or as many clocks as are asked for.
    pub fn interval(&self) -> usize {
        match self.method {
            Method::Axes => self.axes.count().div_ceil(self.axes_per_clock),
            Method::Determinants | Method::Exact => self.clocks_per_pair as usize,
        }
    }

    /// Flags of each kind in an answer: one for each axis, or for each of the nine witnesses.
    pub fn flags(&self) -> u32 {
        match self.method {
            Method::Axes => self.axes.count() as u32,
            Method::Determinants | Method::Exact => 9,
        }
    }

    /// Transform row units side by side: ceil(9 / interval), none without a transform.
    pub fn transform_rows(&self) -> usize {
        match self.transform {
            Transform::Off => 0,
            Transform::On | Transform::Translate => 9usize.div_ceil(self.interval()),
        }
    }

    /// Bits, with the sign, of the coordinates of a pair that the exact unit gets on a grid of its own: differences that fit,
    /// and coordinates inside the declared range.
    pub fn grid_bits(&self) -> u32 {
        match self.truth {
            Truth::Given => self.width,
            Truth::Snapped => self.width.min(self.transform_width - self.int_bits + 1),
        }
    }

    /// Format of input coordinates, matrix entries and translation: s{K}.{T-K}.
    pub fn input(&self) -> efsat_hardware::number::Format {
        efsat_hardware::number::Format::signed(self.transform_width, self.int_bits as i32)
    }

    /// Declared bound on the true magnitude of a coordinate, in mantissas of [`Params::input`]: 1, or without the
    /// transform 2^(K-1) - 2 ulp. That ulp is the input's, but without re-normalisation the working format's, because
    /// then the coordinate is rounded outward to sK.(N-K) and must still fit.
    ///
    /// The exact unit takes any word, unless it has the frame transform; the bound is where a word may end on both sides.
    pub fn coordinate_bound(&self) -> i128 {
        if self.method == Method::Exact && self.truth == Truth::Given {
            return (1 << (self.transform_width - 1)) - 1;
        }
        let ulp = if self.renormalise { 1 } else { 1 << (self.transform_width - self.width) };
        match self.transform {
            Transform::Off => (1 << (self.transform_width - 1)) - 2 * ulp,
            _ => self.one(),
        }
    }

    /// Declared bound on the true magnitude of a translation entry, in mantissas of [`Params::input`]:
    /// 2^(K-1) - 4 - 2^(K-T+3).
    pub fn translation_bound(&self) -> i128 {
        if self.method == Method::Exact && self.truth == Truth::Given {
            return self.coordinate_bound();
        }
        (1 << (self.transform_width - 1)) - 4 * self.one() - 8
    }

    /// The mantissa of 1 in [`Params::input`]: 2^(T-K). Also the declared bound on matrix entries.
    pub fn one(&self) -> i128 {
        1 << (self.transform_width - self.int_bits)
    }

    /// The rule for upper bounds of projections. One that is not outward is `None`: a bound that is rounded down is less
    /// than another number rounded down only where the bound itself is less than the other.
    pub fn projection_upper(&self) -> Option<Upper> {
        (self.projection_width == ProjectionWidth::Rounded).then_some(self.upper)
    }

    /// Places by which an axis can be shifted. The lowest bit of a rounded axis never becomes its sign.
    pub fn axis_positions(&self) -> u32 {
        self.axis_shift.min(self.width - 2)
    }

    /// The table of formats of the axis test.
    pub fn formats(&self) -> Formats {
        Formats::new(self)
    }
}

/// The names of the methods that have an option.
fn methods_with(option: &str) -> String {
    let row = Params::OPTIONS.iter().find(|row| row.name == option);
    let names = row.into_iter().flat_map(|row| row.of).map(|method| options::Choice::name(*method));
    names.collect::<Vec<_>>().join(" or ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_one_axis_per_clock() {
        let p = Params::default();
        assert!(p.validate().is_ok());
        assert_eq!((p.interval(), p.transform_rows(), p.input().to_string()), (11, 1, "s4.28".to_owned()));
    }

    #[test]
    fn every_option_outside_its_range_is_named() {
        type Change = fn(&mut Params);
        let cases: [(Change, &str); 20] = [
            (|p| p.width = 5, "--width 5: expected 6 to 32"),
            (|p| p.width = 33, "--width 33: expected 6 to 32"),
            (|p| p.int_bits = 3, "--int-bits 3: expected 4 to 8 (4 to 8, at most width - 2 = 16)"),
            (|p| p.transform_width = 17, "--transform-width 17: expected 18 to 48 (at least --width 18)"),
            (|p| p.transform_width = 49, "--transform-width 49: expected 18 to 48 (at least --width 18)"),
            (|p| p.axes_per_clock = 12, "--axes-per-clock 12: expected 1 to 11 (--axes 11)"),
            (|p| p.axes_per_clock = 0, "--axes-per-clock 0: expected 1 to 11 (--axes 11)"),
            (|p| p.frequency = 401, "--frequency 401: expected 20 to 400 MHz"),
            (|p| p.tag_width = 65, "--tag-width 65: expected 0 to 64"),
            (|p| p.span = 3, "--span 3: expected --method determinants, which has this option"),
            (|p| p.boxes = false, "--boxes off: expected --method determinants, which has this option"),
            (
                |p| (p.method, p.upper) = (Method::Determinants, Upper::Sticky),
                "--upper sticky: expected --method axes, which has this option",
            ),
            (|p| (p.method, p.span) = (Method::Determinants, 2), "--span 2: expected one of 0, 1, 3"),
            (
                |p| p.clocks_per_pair = 2,
                "--clocks-per-pair 2: expected --method determinants or exact, which has this option",
            ),
            (
                |p| (*p, p.guard) = (Params::of(Method::Exact), Guard::LeftOut),
                "--guard left-out: expected --method axes or determinants, which has this option",
            ),
            (
                |p| (*p, p.transform) = (Params::of(Method::Exact), Transform::On),
                "--transform on: expected off or translate with --method exact, which rounds nothing, unless with --truth \
                 snapped",
            ),
            (
                |p| (*p, p.transform) = (Params::snapped(), Transform::Translate),
                "--transform translate: expected on with --truth snapped",
            ),
            (|p| p.truth = Truth::Snapped, "--truth snapped: expected --method exact, which has this option"),
            (|p| p.exact_clocks = Some(16), "--exact-clocks 16: expected --method exact, which has this option"),
            (
                |p| (*p, p.exact_clocks) = (Params::of(Method::Exact), Some(10)),
                "--exact-clocks 10: expected 11 to 32, or off",
            ),
        ];
        for (change, message) in cases {
            let mut p = Params::default();
            change(&mut p);
            assert_eq!(p.validate().unwrap_err().to_string(), message);
        }
    }
}
