//! What a test answers on the cells of a grid.

use super::grid::{Grid, SIZE};
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::software;
use efsat_unit::host::Reference;
use efsat_unit::pair::Verdict;
use efsat_unit::params::Params;
use rayon::prelude::*;

/// Why no number is refused.
const FINITE: &str = "the pairs are finite";

/// The answers that appear on maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// No common point.
    Separate,
    /// The unit cannot tell.
    PossiblyIncorrect,
    /// Common points of the boundaries alone; only the exact map tells it from `Intersect`.
    Touch,
    /// A common point.
    Intersect,
}

impl Answer {
    fn verdict(self) -> Verdict {
        match self {
            Self::Separate => Verdict::Separate,
            Self::PossiblyIncorrect => Verdict::PossiblyIncorrect,
            Self::Touch | Self::Intersect => Verdict::Intersect,
        }
    }
}

impl From<Verdict> for Answer {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Separate => Self::Separate,
            Verdict::PossiblyIncorrect => Self::PossiblyIncorrect,
            Verdict::Intersect => Self::Intersect,
        }
    }
}

impl From<Exact> for Answer {
    fn from(exact: Exact) -> Self {
        match exact {
            Exact::Separate => Self::Separate,
            Exact::Touch => Self::Touch,
            Exact::Intersect => Self::Intersect,
        }
    }
}

/// One answer a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Map(Vec<Answer>);

impl Map {
    /// Asks a test about all cells, in parallel.
    pub fn of(grid: &Grid, answer: impl Fn(&[[f64; 3]; 6]) -> Answer + Sync) -> Self {
        let cell = |cell: usize| answer(&grid.pair(cell / SIZE, cell % SIZE));
        Self((0..SIZE * SIZE).into_par_iter().map(cell).collect())
    }

    /// What the unit answers.
    pub fn verdicts(grid: &Grid, params: &Params) -> Self {
        let reference = Reference::new(params);
        Self::of(grid, |points| reference.loose(points).expect(FINITE).verdict.into())
    }

    /// What is true.
    pub fn exact(grid: &Grid) -> Self {
        Self::of(grid, |points| exact::pair(points).expect(FINITE).into())
    }

    /// What a test in software answers; it knows `separate` and `intersect` alone.
    pub fn software(grid: &Grid, test: software::Test) -> Self {
        let answer = |meets| if meets { Answer::Intersect } else { Answer::Separate };
        Self::of(grid, |points| answer(test.intersect(points).expect(FINITE)))
    }

    /// A map by row and column.
    pub fn from_fn(answer: impl Fn(usize, usize) -> Answer) -> Self {
        Self((0..SIZE * SIZE).map(|cell| answer(cell / SIZE, cell % SIZE)).collect())
    }

    /// The answer of a cell; rows count from the top.
    pub fn at(&self, row: usize, column: usize) -> Answer {
        self.0[row * SIZE + column]
    }

    /// All cells, row by row from the top.
    pub fn cells(&self) -> &[Answer] {
        &self.0
    }

    /// How many cells have an answer.
    pub fn count(&self, answer: Answer) -> usize {
        self.0.iter().filter(|cell| **cell == answer).count()
    }

    /// How many definite cells differ from the exact map; a touch is an intersection.
    pub fn wrong(&self, exact: &Self) -> usize {
        let truth = |exact: &Answer| if *exact == Answer::Separate { Exact::Separate } else { Exact::Intersect };
        let wrong = |(answer, exact): &(&Answer, &Answer)| answer.verdict().is_wrong(truth(exact));
        self.0.iter().zip(&exact.0).filter(wrong).count()
    }
}
