//! Linear programmes of a few variables over the integers: fraction-free elimination and the criss-cross method.
//!
//! *Arithmetic.* Every row of the tableau is an equation over the free variables and one variable of its own, whose
//! coefficient is the common denominator D. A pivot on the entry p multiplies crosswise and divides by the old D; the
//! new D is p. By Cramer's rule all entries are minors of the first tableau, so every division is exact and no number
//! grows beyond such a minor (Edmonds' integer pivoting, Bareiss' elimination).
//!
//! *Optimisation.* The least-index criss-cross method (Terlaky 1985) needs no feasible start: of all variables whose own
//! row has a negative right side, and of all free ones whose objective coefficient is negative, it takes the one of
//! least index and exchanges it with the one of least index that has the fitting sign in its row or column. It ends
//! after finitely many exchanges, degenerate programmes included, in one of three ways:
//!
//! - no such variable: the tableau is feasible and optimal;
//! - a row without fitting entry: it says that a sum of numbers that are not negative is negative, so there is no
//!   solution;
//! - a column without fitting entry: raising its variable improves any solution without limit, so a programme whose
//!   objective is bounded has no solution.

use num_bigint::{BigInt, Sign};

/// Maximises one variable subject to linear equations, all variables being at least 0.
#[derive(Clone, Debug)]
pub(super) struct Tableau {
    /// Equations, the right side in the last column; the objective is the last row.
    rows: Vec<Vec<BigInt>>,
    /// The variable of each row but the objective.
    own: Vec<usize>,
    /// The variable of each column but the last.
    free: Vec<usize>,
    /// The common denominator, positive.
    denominator: BigInt,
    consistent: bool,
}

impl Tableau {
    /// Solves equations for one variable each; a row is the coefficients of all variables and the right side, and the
    /// last variable is the objective. Equations that follow from others vanish.
    pub fn new(equations: Vec<Vec<BigInt>>) -> Self {
        let (left, variables) = (equations.len(), equations[0].len() - 1);
        let mut objective = vec![BigInt::ZERO; variables + 1];
        objective[variables - 1] = (-1).into();
        let rows = equations.into_iter().chain([objective]).collect();
        let mut tableau =
            Self { rows, own: vec![], free: (0..variables).collect(), denominator: 1.into(), consistent: true };
        for _ in 0..left {
            tableau.eliminate();
        }
        tableau
    }

    /// Solves the first equation without a variable of its own.
    fn eliminate(&mut self) {
        let row = self.own.len();
        match (0..self.free.len()).find(|&column| self.rows[row][column] != BigInt::ZERO) {
            Some(column) => {
                self.pivot(row, column);
                self.own.push(self.free.remove(column));
                for row in &mut self.rows {
                    row.remove(column);
                }
            }
            None => {
                let equation = self.rows.remove(row);
                self.consistent &= equation.last() == Some(&BigInt::ZERO);
            }
        }
    }

    /// The rank of the equations with their right sides.
    pub fn rank(&self) -> usize {
        self.own.len() + usize::from(!self.consistent)
    }

    /// Solves row `row` for the variable of column `column`; the column then belongs to the row's former variable.
    fn pivot(&mut self, row: usize, column: usize) {
        let mut pivoted = std::mem::take(&mut self.rows[row]);
        let pivot = std::mem::replace(&mut pivoted[column], self.denominator.clone());
        for other in self.rows.iter_mut().filter(|other| !other.is_empty()) {
            let factor = -std::mem::take(&mut other[column]);
            for (x, y) in other.iter_mut().zip(&pivoted) {
                *x = (&*x * &pivot + &factor * y) / &self.denominator;
            }
        }
        self.rows[row] = pivoted;
        self.denominator = pivot;
        if self.denominator.sign() == Sign::Minus {
            self.denominator = -std::mem::take(&mut self.denominator);
            for x in self.rows.iter_mut().flatten() {
                *x = -std::mem::take(x);
            }
        }
    }

    /// The greatest value of the objective, which must be bounded, times a positive number; none if the equations have
    /// no solution.
    pub fn maximum(mut self) -> Option<BigInt> {
        while self.consistent {
            let value = self.free.len();
            let objective = self.own.len();
            let negative = |row: usize, column: usize| self.rows[row][column].sign() == Sign::Minus;
            let positive = |row: usize, column: usize| self.rows[row][column].sign() == Sign::Plus;
            let infeasible = (0..objective).filter(|&row| negative(row, value)).min_by_key(|&row| self.own[row]);
            let improving = (0..value).filter(|&column| negative(objective, column)).min_by_key(|&c| self.free[c]);
            let from_row = |row: usize| {
                let fitting = (0..value).filter(|&column| negative(row, column));
                fitting.min_by_key(|&column| self.free[column]).map(|column| (row, column))
            };
            let from_column = |column: usize| {
                let fitting = (0..objective).filter(|&row| positive(row, column));
                fitting.min_by_key(|&row| self.own[row]).map(|row| (row, column))
            };
            let (row, column) = match (infeasible, improving) {
                (None, None) => return self.rows[objective].pop(),
                (Some(row), Some(column)) if self.own[row] > self.free[column] => from_column(column)?,
                (Some(row), _) => from_row(row)?,
                (None, Some(column)) => from_column(column)?,
            };
            self.pivot(row, column);
            std::mem::swap(&mut self.own[row], &mut self.free[column]);
        }
        None
    }
}
