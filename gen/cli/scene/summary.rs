//! Means and greatest counts over the frames of each distance, as the literature reports a turn.

/// One group for each distance, in the order in which they came; frames without one are a group too.
#[derive(Debug)]
pub(super) struct Summary<const N: usize> {
    columns: [&'static str; N],
    groups: Vec<(Option<f64>, Group<N>)>,
}

#[derive(Debug)]
struct Group<const N: usize> {
    frames: u64,
    sum: [u64; N],
    greatest: [u64; N],
}

impl<const N: usize> Group<N> {
    const EMPTY: Self = Self { frames: 0, sum: [0; N], greatest: [0; N] };
}

impl<const N: usize> Summary<N> {
    /// No frame yet; what is counted is called `columns`.
    pub fn new(columns: [&'static str; N]) -> Self {
        Self { columns, groups: vec![] }
    }

    /// Counts a frame.
    pub fn add(&mut self, distance: Option<f64>, counts: [u64; N]) {
        let known = self.groups.iter().position(|(of, _)| *of == distance);
        let index = known.unwrap_or_else(|| {
            self.groups.push((distance, Group::EMPTY));
            self.groups.len() - 1
        });
        let group = &mut self.groups[index].1;
        group.frames += 1;
        for (place, count) in counts.into_iter().enumerate() {
            group.sum[place] += count;
            group.greatest[place] = group.greatest[place].max(count);
        }
    }

    /// Two lines per group, and the sum of all.
    pub fn table(&self) -> String {
        let line = |name: &str, frames: &str, counts: [String; N]| {
            let counts = counts.iter().zip(self.columns);
            let counts: String = counts.map(|(count, name)| format!("{count:>0$}", name.len().max(13) + 2)).collect();
            format!("{name:<20}{frames:>8}{counts}\n")
        };
        let mut text = line("distance", "frames", self.columns.map(str::to_owned));
        let mut total = Group::<N>::EMPTY;
        for (distance, group) in &self.groups {
            let name = distance.map_or("all frames".to_owned(), |distance| distance.to_string());
            let mean = group.sum.map(|sum| format!("{:.1}", sum as f64 / group.frames as f64));
            text.push_str(&line(&format!("{name}, mean"), &group.frames.to_string(), mean));
            text.push_str(&line(&format!("{name}, greatest"), "", group.greatest.map(|count| count.to_string())));
            total.frames += group.frames;
            for (sum, count) in total.sum.iter_mut().zip(group.sum) {
                *sum += count;
            }
        }
        text + &line("all, sum", &total.frames.to_string(), total.sum.map(|count| count.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_grouped_by_distance() {
        let mut summary = Summary::new(["pairs", "touching"]);
        for (distance, touching) in [(Some(1.5), 4), (Some(1.0), 7), (Some(1.5), 1)] {
            summary.add(distance, [10, touching]);
        }
        let table = summary.table();
        let ends: Vec<(&str, &str)> =
            table.lines().map(|line| (line.split("  ").next().unwrap(), line.rsplit(' ').next().unwrap())).collect();
        let expected = [
            ("distance", "touching"),
            ("1.5, mean", "2.5"),
            ("1.5, greatest", "4"),
            ("1, mean", "7.0"),
            ("1, greatest", "7"),
            ("all, sum", "12"),
        ];
        assert_eq!(ends, expected);
    }
}
