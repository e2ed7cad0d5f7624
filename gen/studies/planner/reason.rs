//! Why a stage is needed or not, in words.

use super::Census;
use super::measure::{Measured, Tally};
use super::words::{grouped, power, share};

pub(super) fn broad_phase(objects: usize, census: &Census) -> String {
    format!(
        "{objects} objects: in all poses the boxes of {} of {} pairs of objects overlap",
        grouped(census.meetings),
        grouped(census.object_pairs)
    )
}

pub(super) fn hierarchy(census: &Census) -> String {
    format!(
        "{} of {} pairs of triangles survive, after {} overlap tests",
        grouped(census.statistics.pairs_tested),
        grouped(census.all_pairs),
        grouped(census.statistics.overlap_tests)
    )
}

pub(super) fn degenerate((triangles, degenerate): (u64, u64), census: &Census) -> String {
    format!(
        "{} of {} triangles are degenerate, and {} of {} surviving pairs hold one",
        grouped(degenerate),
        grouped(triangles),
        grouped(census.degenerate_pairs),
        grouped(census.statistics.pairs_tested)
    )
}

/// `measured` tells that the poses would do without the stage, and the verdicts would not.
pub(super) fn transform(census: &Census, measured: bool) -> String {
    let Census { identities, translations, rotations, .. } = census;
    let meetings = identities + translations + rotations;
    let text = format!(
        "of {} meetings with surviving pairs {} are the identity, {} translations, {} rotations",
        grouped(meetings),
        grouped(*identities),
        grouped(*translations),
        grouped(*rotations)
    );
    if measured { text + "; pairs would become less definite" } else { text }
}

pub(super) fn renormalise(census: &Census, with: &Tally, without: &Tally) -> String {
    if with.verdicts.total() == 0 {
        return no_pair();
    }
    format!(
        "smallest pair extent is {} of the domain; {} possibly incorrect without it, {} with it; {}",
        census.smallest.map_or("0".to_owned(), power),
        share(without.verdicts.possibly_incorrect, without.verdicts.total()),
        share(with.verdicts.possibly_incorrect, with.verdicts.total()),
        lost(without)
    )
}

pub(super) fn in_plane_axes(measured: &Measured, with: &Tally, without: &Tally) -> String {
    if with.verdicts.total() == 0 {
        return no_pair();
    }
    format!(
        "{} of {} pairs are within tolerance of coplanar; the six axes decide {}; {}",
        grouped(measured.coplanar),
        grouped(with.verdicts.total()),
        grouped(measured.in_plane),
        lost(without)
    )
}

pub(super) fn exact_ceiling(with: &Tally, without: &Tally) -> String {
    if with.verdicts.total() == 0 {
        return no_pair();
    }
    format!(
        "{} of {} pairs possibly incorrect without it, {} with it; {}",
        grouped(without.verdicts.possibly_incorrect),
        grouped(with.verdicts.total()),
        grouped(with.verdicts.possibly_incorrect),
        lost(without)
    )
}

/// What decides: how many pairs a unit leaves open that the full unit does not.
fn lost(without: &Tally) -> String {
    format!("{} become less definite", grouped(without.less_definite))
}

fn no_pair() -> String {
    "no pair comes to the unit".to_owned()
}
