//! What the colours mean.

use crate::planner::mark::Mark;

/// The longest text in characters.
const LONGEST: usize = 60;
/// Objects that are named.
const OBJECTS: usize = 4;

/// Lines of text, each with a colour or none.
pub(super) struct Legend {
    pub lines: Vec<(Option<[u8; 3]>, String)>,
}

impl Legend {
    pub fn new(scene: &str, frame: usize, label: &str, counts: [usize; 4], objects: Vec<(String, [u8; 3])>) -> Self {
        let mut lines = vec![(None, format!("{scene}, frame {frame}: {label}"))];
        for (mark, count) in Mark::ALL.into_iter().zip(counts).filter(|(_, count)| *count > 0) {
            let pairs = if count == 1 { "pair" } else { "pairs" };
            lines.push((Some(mark.colour()), format!("{}: {count} {pairs}", mark.words())));
        }
        if counts == [0; 4] {
            lines.push((None, "no pair touches or is possibly incorrect".to_owned()));
        }
        let more = objects.len().saturating_sub(OBJECTS);
        lines.extend(objects.into_iter().take(OBJECTS).map(|(name, colour)| (Some(colour), name)));
        if more > 0 {
            lines.push((None, format!("and {more} more objects")));
        }
        for (_, text) in &mut lines {
            if text.chars().count() > LONGEST {
                *text = text.chars().take(LONGEST - 3).chain("...".chars()).collect();
            }
        }
        Self { lines }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_in_the_picture_has_a_row() {
        let rows = |counts: [usize; 4]| -> Vec<String> {
            let legend = Legend::new("gears", 3, "close", counts, vec![("wheel".to_owned(), [1, 2, 3])]);
            legend.lines.into_iter().map(|(_, text)| text).collect()
        };
        for (kind, mark) in Mark::ALL.into_iter().enumerate() {
            let mut counts = [0; 4];
            counts[kind] = 1;
            let row = format!("{}: 1 pair", mark.words());
            assert_eq!(rows(counts), ["gears, frame 3: close", &row, "wheel"]);
        }
        assert_eq!(rows([0; 4]), ["gears, frame 3: close", "no pair touches or is possibly incorrect", "wheel"]);
    }
}
