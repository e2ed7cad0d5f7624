//! Times per query over the distance of the objects, from a table of measurements, as a plot.

use crate::plot::{Axis, BLACK, BLUE, Chart, Dot, GREEN, Line, Mark, ORANGE, PURPLE, SKY, Series, Style, VERMILION};

/// The first line of a table.
pub const HEAD: &str = "series,distance,queries,microseconds";

/// Colours and marks of series, in their order.
const STYLES: [(&str, Mark); 7] = [
    (BLACK, Mark::Circle),
    (VERMILION, Mark::Square),
    (BLUE, Mark::Diamond),
    (GREEN, Mark::Triangle),
    (PURPLE, Mark::Circle),
    (ORANGE, Mark::Square),
    (SKY, Mark::Diamond),
];

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    series: String,
    distance: f64,
    queries: u64,
    microseconds: f64,
}

impl Row {
    fn of(line: &str) -> Option<Self> {
        let fields: Vec<&str> = line.split(',').collect();
        let [series, distance, queries, microseconds] = fields[..] else { return None };
        let positive = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
        Some(Self {
            series: Some(series.trim().to_owned()).filter(|name| !name.is_empty())?,
            distance: positive(distance)?,
            queries: queries.parse().ok()?,
            microseconds: positive(microseconds).filter(|time| *time > 0.0)?,
        })
    }
}

/// The beginning of a line, fit for a message of one line.
fn shown(line: &str) -> String {
    line.chars().take(80).flat_map(char::escape_debug).collect()
}

/// Draws a table: a line for each series, the distance of objects across, the mean time per query upwards.
///
/// # Errors
/// The first line that is no row.
pub fn plot(table: &str) -> Result<String, String> {
    let mut lines = table.lines();
    let head = lines.next().unwrap_or_default();
    if head != HEAD {
        return Err(format!("line 1: found '{}'; expected {HEAD}", shown(head)));
    }
    let mut series: Vec<Series> = vec![];
    for (number, line) in (2..).zip(lines) {
        let row = Row::of(line).ok_or_else(|| {
            let expected = "expected a name, a distance, a number of queries, microseconds per query";
            format!("line {number}: found '{}'; {expected}", shown(line))
        })?;
        let known = series.iter().position(|series| series.name == row.series);
        let index = known.unwrap_or_else(|| {
            let (colour, mark) = STYLES[series.len() % STYLES.len()];
            let style = Style { colour, mark, line: Line::Solid };
            series.push(Series { name: row.series.clone(), style, dots: vec![] });
            series.len() - 1
        });
        let Row { series: name, distance, queries, microseconds } = row;
        let about = format!("{name}: {microseconds} µs per query at distance {distance}, {queries} queries");
        series[index].dots.push(Dot { x: distance, y: microseconds, bounds: None, about });
    }
    if series.is_empty() {
        return Err("line 2: found none; expected a row".to_owned());
    }
    let chart = Chart {
        title: "The closer, the more work".to_owned(),
        about: "Mean time per query over the distance of the objects".to_owned(),
        x: Axis::linear("distance of the centres, half-sizes of the cube"),
        y: Axis::logarithmic("time per query (log scale)").with_unit(" µs"),
        series,
        labels: vec![],
        none: String::new(),
    };
    Ok(chart.svg())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_series_is_drawn() {
        let svg = plot(&format!("{HEAD}\nengine,1.5,360,17.1\nengine,1.4,360,20\nsoftware,1.5,360,155\n")).unwrap();
        for text in ["engine", "software", "engine: 17.1 µs per query at distance 1.5, 360 queries"] {
            assert!(svg.contains(text), "{text}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let wrong = |table: &str| plot(table).unwrap_err();
        assert!(wrong("").starts_with("line 1: found '';"));
        assert!(wrong(HEAD).starts_with("line 2: found none"));
        for row in
            ["engine,1.5,360", "engine,1.5,360,0", "engine,x,360,1", ",1.5,360,1", "engine,1.5,-1,1", "a,1,1,NaN"]
        {
            assert!(wrong(&format!("{HEAD}\nengine,1.5,360,1\n{row}\n")).starts_with("line 3: "), "{row}");
        }
    }
}
