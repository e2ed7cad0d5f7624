//! Plots as SVG: no script, no network, colours that can be told apart without colour vision (M. Okabe, K. Ito, 2008).

mod bars;
mod chart;
mod labels;
mod scale;

pub use bars::{Bar, Bars};
pub use chart::{Chart, Dot, Label, Line, Mark, Series, Style};
pub use scale::Axis;

pub const BLACK: &str = "#1a1a1a";
pub const ORANGE: &str = "#e69f00";
pub const SKY: &str = "#56b4e9";
pub const GREEN: &str = "#009e73";
pub const BLUE: &str = "#0072b2";
pub const VERMILION: &str = "#d55e00";
pub const PURPLE: &str = "#cc79a7";
/// What is not the matter: grids, axes, references.
pub const GREY: &str = "#6b6b6b";

/// Fonts that are on every machine.
const FONT: &str = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";

/// A picture's size, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Size {
    width: f64,
    height: f64,
}

/// Of every chart.
const CHART: Size = Size { width: 760.0, height: 470.0 };

/// A whole number with commas.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Text between tags.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// About how wide a text is.
fn text_width(text: &str, size: f64) -> f64 {
    let of = |c: char| match c {
        'i' | 'l' | 'j' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '(' | ')' | 'f' | 't' | 'r' => 0.33,
        'm' | 'w' | 'M' | 'W' | '%' => 0.88,
        c if c.is_uppercase() => 0.68,
        _ => 0.56,
    };
    1.1 * size * text.chars().map(of).sum::<f64>()
}

/// Lines of words, none wider than that.
fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) + 0.33 * size <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A text at a place; `style` is attributes.
fn text(x: f64, y: f64, style: &str, content: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{}</text>\n", escaped(content))
}

/// The frame of every picture: its size, its name for those who do not see it, its title on top. Gives the text so far,
/// and the height that is taken.
fn begin(size: Size, title: &str, about: &str) -> (String, f64) {
    let Size { width, height } = size;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         font-family=\"{FONT}\" font-size=\"13\" fill=\"{BLACK}\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escaped(title),
        escaped(about)
    );
    let mut y = 4.0;
    for line in wrapped(title, 17.5, width - 8.0) {
        y += 20.0;
        svg.push_str(&text(4.0, y, "font-size=\"16\" font-weight=\"650\"", &line));
    }
    (svg, y + 8.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_wrapped_and_escaped() {
        assert_eq!(wrapped("one two three", 10.0, 47.0), ["one two", "three"]);
        assert_eq!(escaped("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
    }
}
