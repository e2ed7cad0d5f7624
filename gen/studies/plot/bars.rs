//! Horizontal bars.

use super::{CHART, GREY, Size, begin, escaped, text, text_width};

/// A bar; several parts lie side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    pub name: String,
    pub value: f64,
    /// What is written behind it.
    pub text: String,
    pub colour: &'static str,
}

/// A chart of bars from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    pub title: String,
    pub about: String,
    pub bars: Vec<Bar>,
}

/// Height of a bar with its gap.
const ROW: f64 = 31.0;

impl Bars {
    /// The bars as a picture; its height follows from their number.
    pub fn svg(&self) -> String {
        let (_, top) = begin(CHART, &self.title, "");
        let size = Size { height: top + 10.0 + ROW * self.bars.len() as f64, ..CHART };
        let (mut svg, top) = begin(size, &self.title, &self.about);
        let widest = |of: fn(&Bar) -> &str| self.bars.iter().map(|bar| text_width(of(bar), 13.0)).fold(0.0, f64::max);
        let left = 12.0 + widest(|bar| &bar.name);
        let right = size.width - 14.0 - widest(|bar| &bar.text);
        let greatest = self.bars.iter().map(|bar| bar.value).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        for (i, bar) in self.bars.iter().enumerate() {
            let y = top + 6.0 + ROW * i as f64;
            svg.push_str(&text(left - 8.0, y + 15.5, "text-anchor=\"end\"", &bar.name));
            let length = (right - left).max(1.0) * bar.value.max(0.0) / greatest;
            svg.push_str(&format!(
                "<rect x=\"{left:.1}\" y=\"{y:.1}\" width=\"{length:.1}\" height=\"22\" fill=\"{}\"><title>{}</title></rect>\n",
                bar.colour,
                escaped(&format!("{}: {}", bar.name, bar.text))
            ));
            svg.push_str(&text(left + length + 7.0, y + 15.5, "", &bar.text));
        }
        svg.push_str(&format!("<path d=\"M{left:.1} {top:.1}V{:.1}\" stroke=\"{GREY}\"/>\n", size.height - 6.0));
        svg + "</svg>\n"
    }
}
