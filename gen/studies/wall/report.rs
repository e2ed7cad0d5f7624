//! A map of verdicts against the exact map.

use super::grid::SIZE;
use super::groups::{Groups, around, beside, distances, groups};
use super::map::{Answer, Map};
use serde::Serialize;

/// Widths of a band of possibly-incorrect cells, in cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Band {
    /// The least.
    pub min: usize,
    /// The median, the lower one of two.
    pub median: usize,
    /// The greatest.
    pub max: usize,
}

/// What a map of verdicts looks like beside the exact map.
///
/// Two cells belong to the same *side* if the exact answer is `separate` for both or for neither. A *crossing* is
/// where two cells of a column, one above the other, are not on the same side.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Report {
    /// Cells answered `separate`.
    pub separate: usize,
    /// Cells left undecided.
    pub possibly_incorrect: usize,
    /// Cells answered `intersect`.
    pub intersect: usize,
    /// Definite cells that differ from the exact answer; a touch is an intersection.
    pub wrong: usize,
    /// Definite cells with a neighbour, diagonals included, of the other definite verdict.
    pub adjacent: usize,
    /// Columns with a crossing.
    pub lines: usize,
    /// Of these, the ones where some run of possibly-incorrect cells has no crossing in it or at its end.
    pub disordered: usize,
    /// The greatest distance, in cells, from the end of a run at a crossing to the far end of such a run.
    pub fringe: usize,
    /// Groups of cells of one verdict that are cut off: possibly-incorrect ones (joined by sides or corners) without a
    /// wall in them, and definite ones (joined by sides) that are not the greatest of their verdict on a piece of a side.
    pub speckles: usize,
    /// The cells of these groups.
    pub speckle_cells: usize,
    /// The greatest distance, in king's moves, of such a cell from a group of its verdict that is not cut off.
    pub speckle_distance: usize,
    /// Lengths of the possibly-incorrect runs at the crossings.
    pub band: Option<Band>,
}

impl Report {
    /// Compares a map of verdicts with the exact map.
    pub fn new(verdicts: &Map, exact: &Map) -> Self {
        let mut report = Self {
            separate: verdicts.count(Answer::Separate),
            possibly_incorrect: verdicts.count(Answer::PossiblyIncorrect),
            intersect: verdicts.count(Answer::Intersect),
            wrong: verdicts.wrong(exact),
            ..Self::default()
        };
        report.look_around(verdicts);
        report.walk(verdicts, exact);
        report.isolate(verdicts, exact);
        report
    }

    /// What must not be, in words.
    ///
    /// No definite cell is wrong. Nothing strays farther from the band than the band is wide: its edges are where an
    /// error bound decides, and that bound varies from cell to cell with the bits that are rounded away, between zero
    /// and its greatest value, which is the band's own scale.
    pub fn fault(&self) -> Option<String> {
        if self.wrong > 0 {
            return Some(format!("{} wrong definite cells", self.wrong));
        }
        let widest = self.band?.max;
        let strayed = self.fringe.max(self.speckle_distance);
        (strayed > widest).then(|| format!("a cell strays {strayed} cells from its like; the band is {widest} wide"))
    }

    /// Cell by cell.
    fn look_around(&mut self, verdicts: &Map) {
        for (cell, &verdict) in verdicts.cells().iter().enumerate() {
            let other = |at: usize| ![Answer::PossiblyIncorrect, verdict].contains(&verdicts.cells()[at]);
            self.adjacent += usize::from(verdict != Answer::PossiblyIncorrect && around(cell).any(other));
        }
    }

    /// Column by column, through the wall.
    fn walk(&mut self, verdicts: &Map, exact: &Map) {
        let mut widths = vec![];
        for column in 0..SIZE {
            let crosses = |row: usize| apart(exact.at(row, column)) != apart(exact.at(row + 1, column));
            let crossings: Vec<usize> = (0..SIZE - 1).filter(|&row| crosses(row)).collect();
            if crossings.is_empty() {
                continue;
            }
            self.lines += 1;
            let undecided = runs(|row| verdicts.at(row, column) == Answer::PossiblyIncorrect);
            // A crossing is between its row and the next one.
            let at_wall = |&(from, to): &(usize, usize)| crossings.iter().any(|&row| from <= row + 1 && row < to);
            let (walls, strays): (Vec<_>, Vec<_>) = undecided.into_iter().partition(at_wall);
            self.disordered += usize::from(!strays.is_empty());
            // A crossing between two definite cells is a band without width.
            let bare = |row: &usize| !walls.iter().any(|&(from, to)| from <= row + 1 && *row < to);
            let bare: Vec<_> = crossings.iter().filter(|row| bare(row)).map(|row| (row + 1, row + 1)).collect();
            let walls = [walls, bare].concat();
            for (from, to) in strays {
                let beyond = |wall: &(usize, usize)| if to <= wall.0 { wall.0 - from } else { to - wall.1 };
                self.fringe = self.fringe.max(walls.iter().map(beyond).min().unwrap_or(SIZE));
            }
            widths.extend(walls.iter().map(|(from, to)| to - from));
        }
        widths.sort_unstable();
        if let (Some(&min), Some(&max)) = (widths.first(), widths.last()) {
            self.band = Some(Band { min, median: widths[(widths.len() - 1) / 2], max });
        }
    }

    /// Group by group.
    fn isolate(&mut self, verdicts: &Map, exact: &Map) {
        let sides = |cell: usize| apart(exact.cells()[cell]);
        let wall =
            |&cell: &usize| exact.cells()[cell] == Answer::Touch || around(cell).any(|o| sides(o) != sides(cell));
        let undecided = |cell: usize| verdicts.cells()[cell] == Answer::PossiblyIncorrect;
        let (kept, cut) =
            groups(|cell| undecided(cell).then_some(0), around).into_iter().partition(|group| group.iter().any(wall));
        self.cut_off(kept, cut);
        for piece in groups(|cell| Some(u8::from(sides(cell))), beside) {
            let mut inside = vec![false; SIZE * SIZE];
            piece.iter().for_each(|&cell| inside[cell] = true);
            for verdict in [Answer::Separate, Answer::Intersect] {
                let own = |cell: usize| (inside[cell] && verdicts.cells()[cell] == verdict).then_some(0);
                let mut cut = groups(own, beside);
                cut.sort_by_key(|group| group.len());
                let kept = cut.pop().into_iter().collect();
                self.cut_off(kept, cut);
            }
        }
    }

    /// Counts the groups that are cut off from those that are kept.
    fn cut_off(&mut self, kept: Groups, cut: Groups) {
        self.speckles += cut.len();
        self.speckle_cells += cut.iter().map(Vec::len).sum::<usize>();
        let distance = distances(&kept.concat());
        let farthest = cut.iter().flatten().map(|&cell| distance[cell]).max();
        self.speckle_distance = self.speckle_distance.max(farthest.unwrap_or(0));
    }
}

/// Whether an exact answer is `separate`.
fn apart(answer: Answer) -> bool {
    answer == Answer::Separate
}

/// The maximal ranges of rows for which something holds.
fn runs(holds: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = vec![];
    for row in (0..SIZE).filter(|&row| holds(row)) {
        match runs.last_mut() {
            Some((_, to)) if *to == row => *to += 1,
            _ => runs.push((row, row + 1)),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    const WALL: usize = SIZE / 2;

    /// Separate above a horizontal wall of touches, intersect below.
    fn exact() -> Map {
        Map::from_fn(|row, _| match row {
            0..WALL => Answer::Separate,
            WALL => Answer::Touch,
            _ => Answer::Intersect,
        })
    }

    /// A straight band: ten rows above the wall, the wall, nine below; but for some cells.
    fn verdicts(planted: &[(usize, usize, Answer)]) -> Map {
        Map::from_fn(|row, column| {
            let straight = match row {
                0..118 => Answer::Separate,
                118..138 => Answer::PossiblyIncorrect,
                _ => Answer::Intersect,
            };
            let here = planted.iter().find(|(r, c, _)| (*r, *c) == (row, column));
            here.map_or(straight, |(_, _, answer)| *answer)
        })
    }

    fn report(planted: &[(usize, usize, Answer)]) -> Report {
        Report::new(&verdicts(planted), &exact())
    }

    #[test]
    fn a_straight_band_is_in_order() {
        let expected = Report {
            separate: 118 * SIZE,
            possibly_incorrect: 20 * SIZE,
            intersect: 118 * SIZE,
            lines: SIZE,
            band: Some(Band { min: 20, median: 20, max: 20 }),
            ..Report::default()
        };
        assert_eq!(report(&[]), expected);
        assert_eq!(expected.fault(), None);
    }

    #[test]
    fn a_wrong_cell_is_seen() {
        for (row, answer) in [(WALL - 1, Answer::Intersect), (WALL, Answer::Separate), (WALL + 1, Answer::Separate)] {
            let report = report(&[(row, 7, answer)]);
            assert_eq!((report.wrong, report.fault().unwrap().as_str()), (1, "1 wrong definite cells"));
        }
        // Right, as a touch is an intersection.
        assert_eq!(report(&[(WALL, 7, Answer::Intersect)]).wrong, 0);
    }

    #[test]
    fn definite_verdicts_side_by_side_are_seen() {
        let planted = [(WALL - 1, 7, Answer::Separate), (WALL, 8, Answer::Intersect)];
        let report = report(&planted);
        assert_eq!((report.adjacent, report.wrong), (2, 0));
    }

    #[test]
    fn speckles_are_seen_with_their_distance() {
        use Answer::{Intersect, PossiblyIncorrect, Separate};
        // Near the band: possibly-incorrect in separate, and separate in the band.
        let near = report(&[(115, 3, PossiblyIncorrect), (120, 9, Separate)]);
        assert_eq!((near.speckles, near.speckle_cells, near.speckle_distance), (2, 2, 3));
        assert_eq!((near.disordered, near.fringe, near.wrong), (2, 3, 0));
        assert_eq!(near.fault(), None);
        // Far from it.
        for (row, distance) in [(90, 28), (166, 29)] {
            let far = report(&[(row, 3, PossiblyIncorrect), (row, 4, PossiblyIncorrect)]);
            assert_eq!((far.speckles, far.speckle_cells, far.speckle_distance, far.fringe), (1, 2, distance, distance));
            assert!(far.fault().unwrap().starts_with(&format!("a cell strays {distance} cells")));
        }
        // Joined by a corner, a possibly-incorrect cell belongs to the band; a definite one is cut off.
        let corner = [(117, 3, PossiblyIncorrect), (116, 4, PossiblyIncorrect)];
        assert_eq!(report(&corner).speckles, 0);
        let corner = [(137, 3, Intersect), (136, 4, Intersect)];
        assert_eq!((report(&corner).speckles, report(&corner).speckle_distance), (1, 1));
    }

    #[test]
    fn a_wall_without_a_band_has_width_zero() {
        let sharp = Map::from_fn(|row, _| if row < WALL { Answer::Separate } else { Answer::Intersect });
        let report = Report::new(&sharp, &exact());
        assert_eq!(report.band, Some(Band { min: 0, median: 0, max: 0 }));
        assert_eq!((report.wrong, report.adjacent, report.fault()), (0, 2 * SIZE, None));
    }
}
