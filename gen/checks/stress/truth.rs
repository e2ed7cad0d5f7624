//! The exact answers that verdicts are compared with, each from formulations that share no code.

use super::posed::Posed;
use efsat_geometry::Points;
use efsat_geometry::exact::{self, Exact, Relation, linear_programme};
use efsat_geometry::software::retest::{retest, retest_posed};
use std::fmt;

/// Why no number is refused.
const FINITE: &str = "cases are finite";

/// What each formulation says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answers {
    /// The oracle's facets of the Minkowski difference.
    pub facets: Relation,
    /// Its linear programme.
    pub programme: Relation,
    /// The software retest.
    pub retest: Exact,
}

impl Answers {
    /// The oracle's answer, which is everyone's if all agree.
    pub fn class(&self) -> Exact {
        self.facets.class
    }

    /// Whether all say the same.
    pub fn agree(&self) -> bool {
        self.facets == self.programme && self.retest == self.class()
    }
}

impl fmt::Display for Answers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "facets {}, linear programme {}, retest {}", self.facets, self.programme, self.retest)
    }
}

/// All formulations for a pair in one frame.
pub(super) fn loose(points: &Points) -> Answers {
    Answers {
        facets: exact::relation(points).expect(FINITE),
        programme: linear_programme::relation(points).expect(FINITE),
        retest: retest(points).expect(FINITE),
    }
}

/// All formulations for a pair under a pose.
pub(super) fn posed(posed: &Posed) -> Answers {
    let Posed { a, b, motion } = posed;
    Answers {
        facets: exact::posed_relation(a, b, &motion.m, &motion.t).expect(FINITE),
        programme: linear_programme::posed_relation(a, b, &motion.m, &motion.t).expect(FINITE),
        retest: retest_posed(a, b, &motion.m, &motion.t).expect(FINITE),
    }
}
