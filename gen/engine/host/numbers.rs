//! The words of a query from a pose.

use super::image::{Header, Image};
use crate::format::EngineFormat;
use crate::model::{Frame, Query, QueryRow, Side};
use crate::params::EngineParams;
use efsat_geometry::finite::{self, NotFinite};
use efsat_unit::dyadic::Dyadic;
use efsat_unit::pair::{Input, Pose};
use efsat_unit::params::{ParamError, Params};
use nalgebra::{Matrix3, Vector3};

/// Why a query is answered in software.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// A number of the pose that is infinite or no number.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// An image that was made for another engine.
    #[error("image {side}: another format than the engine's; expected one that was built for it")]
    Format {
        /// Which image.
        side: char,
    },
    /// Images of different scales.
    #[error("images of scales 2^{} and 2^{}: expected one scale", .0[0], .0[1])]
    Scale([i32; 2]),
    /// A tree with more levels than the stack is made for.
    #[error("image {side}: a tree of height {found}; expected at most {most}")]
    Height {
        /// Which image.
        side: char,
        /// Its height.
        found: u32,
        /// The greatest height.
        most: u32,
    },
    /// A tree with more blocks than the stack has numbers for.
    #[error("image {side}: {found} blocks; expected at most {most}")]
    Blocks {
        /// Which image.
        side: char,
        /// How many.
        found: u32,
        /// How many there may be.
        most: u32,
    },
    /// A matrix entry outside the declared range.
    #[error("entry {row}, {column} of the matrix: {found}; expected -1 to 1")]
    Entry {
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
        /// What was found.
        found: f64,
    },
    /// A translation outside the declared range: the objects are so far apart that their boxes do not meet, or all but.
    #[error("translation along axis {axis}, in the scale of the images: outside the declared range")]
    Translation {
        /// Its axis.
        axis: usize,
    },
    /// A direction of which the factors miss too much: the matrix is far from a rotation.
    #[error("row of direction {direction}: a rest of {found}; expected at most {most}")]
    Rest {
        /// Its direction.
        direction: usize,
        /// What it would be.
        found: i64,
        /// What its field holds.
        most: i64,
    },
}

/// Matrix entries are taken as multiples of 2^-FINE, or as lying between two of them.
pub(crate) const FINE: u32 = 40;

/// Makes queries for one engine.
#[derive(Clone, Debug)]
pub struct Numbers {
    format: EngineFormat,
    unit: Params,
    blocks: u32,
}

/// An entry of the matrix: its floor in steps of 2^-FINE, and 1 if it is greater.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fine {
    floor: i64,
    above: i64,
}

impl Numbers {
    /// For an engine and the unit behind it.
    ///
    /// # Errors
    /// If the parameters are outside their ranges.
    pub fn new(engine: &EngineParams, unit: &Params) -> Result<Self, ParamError> {
        Ok(Self { format: engine.format(unit)?, unit: unit.clone(), blocks: 1 << engine.block_number_bits })
    }

    /// The formats.
    pub fn format(&self) -> &EngineFormat {
        &self.format
    }

    /// The unit behind the engine.
    pub(super) fn unit(&self) -> &Params {
        &self.unit
    }

    /// The query for all contacts of two images, with B at M x + t in the frame of A; `m` is indexed `[row][column]`, all in
    /// the coordinates of the meshes, and taken as exact. Both may be the same image.
    ///
    /// # Errors
    /// If a number is not finite; or if the engine cannot answer the query, which software then has to do.
    pub fn query(&self, images: [(&Image, Side); 2], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Query, Refusal> {
        finite::pose(m, t)?;
        let headers = images.map(|(image, _)| image.header());
        self.fit(headers)?;
        let pose = self.pose(headers, m, t)?;
        let fine = m.map(|row| row.map(Fine::of));
        let matrix = Frame::matrix(&pose, &self.format);
        let rows = self.rows(m, &fine)?;
        Ok(Query {
            sides: images.map(|(_, side)| side),
            limit: 0,
            first_contact: false,
            all_pairs: false,
            leaf_pairs: false,
            keep_caches: false,
            number: 0,
            errors: [0, 1, 2].map(|axis| self.shift_error(&fine[axis], &matrix[axis])),
            pose,
            rows,
        })
    }

    /// Whether both images are for this engine and for each other.
    fn fit(&self, headers: [&Header; 2]) -> Result<(), Refusal> {
        for (side, header) in ['A', 'B'].into_iter().zip(headers) {
            let same =
                |format: &EngineFormat| (format.block(), format.triangle(), format.transform_width, format.int_bits);
            if same(&header.format) != same(&self.format) {
                return Err(Refusal::Format { side });
            }
            let most = self.format.tree_height;
            if header.height > most {
                return Err(Refusal::Height { side, found: header.height, most });
            }
            if header.blocks > self.blocks {
                return Err(Refusal::Blocks { side, found: header.blocks, most: self.blocks });
            }
        }
        match headers.map(|header| header.power) {
            [a, b] if a != b => Err(Refusal::Scale([a, b])),
            _ => Ok(()),
        }
    }

    /// The pose words: M, and t' = 2^power (M c_B + t - c_A), exactly, then rounded down.
    pub(super) fn pose(&self, [a, b]: [&Header; 2], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Pose, Refusal> {
        let fraction = self.format.word_fraction();
        let mut pose = Pose { m: [[Input::default(); 3]; 3], t: [Input::default(); 3], bypass: false };
        for (row, entries) in m.iter().enumerate() {
            let mut shift = Dyadic::from(t[row]) - Dyadic::from(a.centre[row]);
            for (column, &found) in entries.iter().enumerate() {
                let entry = Dyadic::from(found).quantised(fraction, self.unit.one());
                pose.m[row][column] = self.input(entry.ok_or(Refusal::Entry { row, column, found })?);
                shift = shift + Dyadic::from(found) * Dyadic::from(b.centre[column]);
            }
            let shift = shift.scaled(a.power.into()).quantised(fraction, self.unit.translation_bound());
            pose.t[row] = self.input(shift.ok_or(Refusal::Translation { axis: row })?);
        }
        Ok(pose)
    }

    /// A number as it travels: without its sticky bit, if the unit has none.
    fn input(&self, x: Input) -> Input {
        Input { sticky: x.sticky && self.format.sticky, ..x }
    }

    /// What is missing from D along one axis of A: what the matrix entries miss of an origin, which is at most 1, one step for
    /// the floor of the sum and what the shift was rounded by, in steps of the grid, rounded up.
    pub(super) fn shift_error(&self, exact: &[Fine; 3], rounded: &[i64; 3]) -> u32 {
        let grid = self.format.grid_fraction();
        let step = FINE - self.format.origin_fraction();
        let missed = exact.iter().zip(rounded).map(|(x, &rounded)| (x.floor - (rounded << step)).abs() + x.above);
        (up(missed.sum(), FINE - grid) + i64::from(self.format.shift_rounding())) as u32
    }

    /// The rows of a query.
    pub(super) fn rows(&self, m: &[[f64; 3]; 3], fine: &[[Fine; 3]; 3]) -> Result<Vec<QueryRow>, Refusal> {
        (0..self.format.directions.count()).step_by(2).map(|h| self.row(h, m, fine)).collect()
    }

    /// The row of a direction h: w = M^T h as a sum of three directions, and an upper bound of what the rounded factors miss. With
    /// the opposite directions it is that of -h.
    pub(super) fn row(&self, h: usize, m: &[[f64; 3]; 3], fine: &[[Fine; 3]; 3]) -> Result<QueryRow, Refusal> {
        let format = &self.format;
        let normal = format.directions.vector(h);
        // Whole numbers below 2^53: nothing is rounded before the factors are.
        let whole = Matrix3::from_fn(|i, j| (m[i][j] * 2f64.powi(FINE as i32)).trunc());
        let w = whole.transpose() * Vector3::from(normal.map(f64::from));
        let step = FINE - format.factor_fraction();
        let (unit, most) = (2f64.powi(-(step as i32)), f64::from((1 << format.factor_bits) - 1));
        let terms = format.directions.in_slots(format.directions.combination(&w));
        let terms = terms.map(|(choice, factor)| (choice as u32, (factor * unit).round().clamp(0.0, most) as u32));
        let missed = (0..3).map(|axis| {
            let kept = terms.iter().zip(format.directions.slots()).map(|(&(choice, factor), slot)| {
                let n = format.directions.vector(slot[choice as usize].into())[axis];
                i64::from(n) * i64::from(factor)
            });
            let column = || normal.iter().zip(fine).map(|(&n, row)| (i64::from(n), row[axis]));
            let exact: i64 = column().map(|(n, x)| n * x.floor).sum();
            let above: i64 = column().map(|(n, x)| n.abs() * x.above).sum();
            (exact - (kept.sum::<i64>() << step)).abs() + above
        });
        let missed: i64 = missed.sum();
        let found = up(missed * i64::from(format.most()), step);
        let most = (1i64 << format.rest_bits()) - 1;
        match found <= most {
            true => Ok(QueryRow { terms, rest: found as u32 }),
            false => Err(Refusal::Rest { direction: h, found, most }),
        }
    }
}

impl Fine {
    /// Of a number from -1 to 1.
    pub fn of(x: f64) -> Self {
        let scaled = x * 2f64.powi(FINE as i32);
        Self { floor: scaled.floor() as i64, above: i64::from(scaled.floor() != scaled) }
    }
}

/// x / 2^drop, rounded up.
fn up(x: i64, drop: u32) -> i64 {
    -(-x >> drop)
}
