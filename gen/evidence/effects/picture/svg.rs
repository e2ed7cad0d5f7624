//! The picture as SVG: triangles of one colour that follow each other are one path.

use super::view::Item;
use super::{HEIGHT, Picture, WIDTH};
use std::fmt::Write;

impl Picture {
    /// The picture as SVG, self-contained. Equal pictures are equal bytes.
    pub fn svg(&self) -> String {
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} \
             {HEIGHT}\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n<g stroke-width=\".5\" \
             stroke-linejoin=\"round\">\n"
        );
        paths(&mut out, &self.seen, None);
        paths(&mut out, &self.marked, Some("#000"));
        out.push_str("</g>\n<g font-family=\"sans-serif\" font-size=\"15\" fill=\"#000\">\n");
        for (row, (colour, text)) in self.legend.lines.iter().enumerate() {
            let y = 24 + 20 * row;
            if let Some(colour) = colour {
                let fill = hex(*colour);
                let top = y - 12;
                // The outline shows pale colours on white.
                let _ = writeln!(
                    out,
                    "<rect x=\"20\" y=\"{top}\" width=\"20\" height=\"14\" fill=\"{fill}\" stroke=\"#000\" \
                     stroke-width=\".5\"/>"
                );
            }
            let x = if colour.is_some() { 48 } else { 20 };
            let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\">{}</text>", escaped(text));
        }
        out.push_str("</g>\n</svg>\n");
        out
    }
}

/// Paths of triangles, in their order; `outline` or the colour itself around each, which hides the seams.
fn paths(out: &mut String, items: &[Item], outline: Option<&str>) {
    for run in items.chunk_by(|x, y| x.colour == y.colour) {
        let fill = hex(run[0].colour);
        let _ = write!(out, "<path fill=\"{fill}\" stroke=\"{}\" d=\"", outline.unwrap_or(&fill));
        for item in run {
            // In tenths of a pixel, each corner from the one before.
            let [p, q, r] = item.corners.map(|corner| [corner[0], corner[1]].map(|x| (x * 10.0).round() as i64));
            let step =
                |from: [i64; 2], to: [i64; 2]| format!("{} {}", tenths(to[0] - from[0]), tenths(to[1] - from[1]));
            let _ = write!(out, "M{} {}l{} {}z", tenths(p[0]), tenths(p[1]), step(p, q), step(q, r));
        }
        out.push_str("\"/>\n");
    }
}

fn tenths(number: i64) -> String {
    let (whole, rest) = (number.abs() / 10, number.abs() % 10);
    let sign = if number < 0 { "-" } else { "" };
    match rest {
        0 => format!("{sign}{whole}"),
        rest => format!("{sign}{whole}.{rest}"),
    }
}

fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
