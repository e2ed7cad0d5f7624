//! A map of verdicts against the exact map.

use super::grid::SIZE;
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
    /// Cells with a neighbour, diagonals included, of the other definite verdict.
    pub unguarded: usize,
    /// Columns with a crossing.
    pub lines: usize,
    /// Of these, the ones where some run of possibly-incorrect cells has no crossing in it or at its end.
    pub disordered: usize,
    /// The greatest distance, in cells, of such a run from the run at a crossing.
    pub ragged: usize,
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
            ..Self::default()
        };
        report.compare(verdicts, exact);
        report.walk(verdicts, exact);
        report.isolate(verdicts, exact);
        report
    }

    fn compare(&mut self, verdicts: &Map, exact: &Map) {
        for (i, (&verdict, &exact)) in verdicts.cells().iter().zip(exact.cells()).enumerate() {
            let wrong = match verdict {
                Answer::PossiblyIncorrect => continue,
                Answer::Separate => !apart(exact),
                _ => apart(exact),
            };
            self.wrong += usize::from(wrong);
            let other = |j: usize| {
                let neighbour = verdicts.cells()[j];
                neighbour != Answer::PossiblyIncorrect && neighbour != verdict
            };
            self.unguarded += usize::from(around(i).any(other));
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
            for &(from, to) in &strays {
                let distance = |&(wall_from, wall_to): &(usize, usize)| {
                    if to <= wall_from {
                        wall_from - from
                    } else {
                        to - wall_to
                    }
                };
                self.ragged = self.ragged.max(walls.iter().map(distance).min().unwrap_or(SIZE));
            }
            // A crossing between two definite cells is a band without width.
            let bare = |&&row: &&usize| !walls.iter().any(|&(from, to)| from <= row + 1 && row < to);
            widths.extend(crossings.iter().filter(bare).map(|_| 0));
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

/// Cells in groups.
type Groups = Vec<Vec<usize>>;

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

/// The up to eight cells around a cell, by index.
fn around(cell: usize) -> impl Iterator<Item = usize> {
    let (row, column) = (cell / SIZE, cell % SIZE);
    let near = |x: usize| x.saturating_sub(1)..(x + 2).min(SIZE);
    near(row).flat_map(move |r| near(column).map(move |c| r * SIZE + c)).filter(move |&other| other != cell)
}

/// The up to four cells that share a side with a cell, by index.
fn beside(cell: usize) -> impl Iterator<Item = usize> {
    around(cell).filter(move |&other| other / SIZE == cell / SIZE || other % SIZE == cell % SIZE)
}

/// The cells that have a key, in groups of one key and joined by neighbourhood.
fn groups<N: Iterator<Item = usize>>(key: impl Fn(usize) -> Option<u8>, neighbours: impl Fn(usize) -> N) -> Groups {
    let mut seen = vec![false; SIZE * SIZE];
    let mut groups = vec![];
    for start in 0..SIZE * SIZE {
        let Some(of_group) = key(start) else { continue };
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let mut group = vec![start];
        let mut next = 0;
        while next < group.len() {
            for other in neighbours(group[next]) {
                if !seen[other] && key(other) == Some(of_group) {
                    seen[other] = true;
                    group.push(other);
                }
            }
            next += 1;
        }
        groups.push(group);
    }
    groups
}

/// How many king's moves every cell is from the nearest of some cells; SIZE if there are none.
fn distances(from: &[usize]) -> Vec<usize> {
    let mut distance = vec![SIZE; SIZE * SIZE];
    let mut reached = from.to_vec();
    reached.iter().for_each(|&cell| distance[cell] = 0);
    let mut next = 0;
    while next < reached.len() {
        let cell = reached[next];
        for other in around(cell) {
            if distance[other] > distance[cell] + 1 {
                distance[other] = distance[cell] + 1;
                reached.push(other);
            }
        }
        next += 1;
    }
    distance
}
