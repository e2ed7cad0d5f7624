//! The dual question: with so many multipliers, how fast can each width be?

use super::Hardware;
use efsat_checks::synth::SynthError;
use efsat_unit::params::Params;
use rayon::prelude::*;

/// The fastest folding of a width within a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Folding {
    /// Multipliers there are.
    pub budget: u64,
    /// The working width.
    pub width: u32,
    /// The parameters, if a folding fits.
    pub params: Option<Params>,
    /// Multipliers of the slowest folding that the generator has: one axis per clock.
    pub least: u64,
}

/// The numbers of axis units that differ in speed, the fewest units for each, ascending.
fn foldings(base: &Params) -> Vec<usize> {
    let interval = |n: usize| base.axes.count().div_ceil(n);
    let mut distinct: Vec<usize> = (1..=base.axes.count()).collect();
    distinct.dedup_by_key(|n| interval(*n));
    distinct
}

/// Parameters with their predicted multipliers.
type Known = Vec<(Params, u64)>;

/// The foldings of a width with their predicted multipliers, ascending, up to the first that is beyond the budget.
fn known(base: &Params, width: u32, budget: u64) -> Result<Known, SynthError> {
    let mut known = Known::new();
    for axes_per_clock in foldings(base) {
        let params = Params { width, axes_per_clock, ..base.clone() };
        let multipliers = Hardware::predict(&params)?.cells.multipliers;
        known.push((params, multipliers));
        if multipliers > budget {
            break;
        }
    }
    Ok(known)
}

/// The fastest folding of each width within each budget, by predicted multipliers.
///
/// # Errors
/// That a design cannot be made.
pub fn fastest(base: &Params, widths: &[u32], budgets: &[u64]) -> Result<Vec<Folding>, SynthError> {
    let Some(most) = budgets.iter().max() else { return Ok(vec![]) };
    let all: Vec<Known> = widths.par_iter().map(|width| known(base, *width, *most)).collect::<Result<_, _>>()?;
    let folding = |(budget, (width, known)): (&u64, (&u32, &Known))| Folding {
        budget: *budget,
        width: *width,
        params: known.iter().rev().find(|(_, multipliers)| multipliers <= budget).map(|(params, _)| params.clone()),
        least: known[0].1,
    };
    let pairs = budgets.iter().flat_map(|budget| widths.iter().zip(&all).map(move |of_width| (budget, of_width)));
    Ok(pairs.map(folding).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_budget_holds_18_bits_and_no_more() {
        let all = fastest(&Params::paper(), &[12, 18, 19], &[72, 216]).unwrap();
        let units = |budget: u64, width: u32| {
            let folding = all.iter().find(|f| (f.budget, f.width) == (budget, width)).unwrap();
            (folding.params.as_ref().map(|p| p.axes_per_clock), folding.least)
        };
        assert_eq!((units(72, 12), units(72, 18)), ((Some(1), 60), (Some(1), 60)));
        assert_eq!(units(72, 19).0, None);
        assert!(units(72, 19).1 > 144);
        assert_eq!((units(216, 18).0, units(216, 19).0), (Some(3), Some(1)));
        assert_eq!(fastest(&Params::default(), &[18], &[]).unwrap(), []);
    }

    #[test]
    fn foldings_differ_in_speed() {
        assert_eq!(foldings(&Params::default()), [1, 2, 3, 4, 6, 11]);
    }
}
