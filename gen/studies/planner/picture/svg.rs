//! The picture as SVG: triangles of one colour that follow each other are one path.

use super::view::{Frame, Item};
use super::{BODY, CONTACT, HEIGHT, Picture, WIDTH};
use std::fmt::Write;

impl Picture {
    /// The picture as SVG, self-contained. Equal pictures are equal bytes.
    pub fn svg(&self) -> String {
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} \
             {HEIGHT}\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n<g stroke-width=\".5\" \
             stroke-linejoin=\"round\">\n"
        );
        for (number, pane) in self.panes.iter().enumerate() {
            let Frame { low: [left, top], .. } = pane.window;
            let [width, height] = pane.window.size();
            let _ = writeln!(
                out,
                "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" viewBox=\"{left} {top} {width} {height}\">"
            );
            if number > 0 {
                let _ = writeln!(
                    out,
                    "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>"
                );
            }
            for body in &pane.bodies {
                let _ = writeln!(out, "<g opacity=\"{BODY}\">");
                paths(&mut out, body, None);
                out.push_str("</g>\n");
            }
            let _ = writeln!(out, "<g opacity=\"{CONTACT}\">");
            paths(&mut out, &pane.marked, Some("#000"));
            out.push_str(
                "</g>\n<path fill=\"none\" stroke=\"#000\" stroke-width=\"2.2\" stroke-linecap=\"round\" d=\"",
            );
            for [[x0, y0], [x1, y1]] in &pane.segments {
                let _ = write!(out, "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}");
            }
            out.push_str("\"/>\n</svg>\n");
        }
        for Frame { low: [left, top], high: [right, bottom] } in self.outlines() {
            let _ = writeln!(
                out,
                "<path fill=\"none\" stroke=\"#000\" stroke-width=\"1.2\" d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}z\"/>"
            );
        }
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
