//! Cells that hang together.

use super::grid::SIZE;

/// Cells in groups.
pub(super) type Groups = Vec<Vec<usize>>;

/// The up to eight cells around a cell, by index.
pub(super) fn around(cell: usize) -> impl Iterator<Item = usize> {
    let (row, column) = (cell / SIZE, cell % SIZE);
    let near = |x: usize| x.saturating_sub(1)..(x + 2).min(SIZE);
    near(row).flat_map(move |r| near(column).map(move |c| r * SIZE + c)).filter(move |&other| other != cell)
}

/// The up to four cells that share a side with a cell, by index.
pub(super) fn beside(cell: usize) -> impl Iterator<Item = usize> {
    around(cell).filter(move |&other| other / SIZE == cell / SIZE || other % SIZE == cell % SIZE)
}

/// The cells that have a key, in groups of one key and joined by neighbourhood.
pub(super) fn groups<N: Iterator<Item = usize>>(
    key: impl Fn(usize) -> Option<u8>,
    neighbours: impl Fn(usize) -> N,
) -> Groups {
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
pub(super) fn distances(from: &[usize]) -> Vec<usize> {
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
