//! Horizontal bars.

use super::{GREY, Size, begin, escaped, text, text_width};

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

/// Height of a bar with its gap, where the name stands beside it and where it stands above.
const ROW: f64 = 31.0;
const TALL_ROW: f64 = 46.0;

impl Bars {
    /// The bars as a picture of this width; its height follows from their number.
    pub fn svg(&self, size: Size) -> String {
        let narrow = size.width < 500.0;
        let row = if narrow { TALL_ROW } else { ROW };
        let (_, top) = begin(size, &self.title, "");
        let size = Size { height: top + 10.0 + row * self.bars.len() as f64, ..size };
        let (mut svg, top) = begin(size, &self.title, &self.about);
        let widest = |of: fn(&Bar) -> &str| self.bars.iter().map(|bar| text_width(of(bar), 13.0)).fold(0.0, f64::max);
        let left = if narrow { 4.0 } else { 12.0 + widest(|bar| &bar.name) };
        let right = size.width - 14.0 - widest(|bar| &bar.text);
        let greatest = self.bars.iter().map(|bar| bar.value).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        for (i, bar) in self.bars.iter().enumerate() {
            let y = top + 6.0 + row * i as f64;
            let (name_y, bar_y) = if narrow { (y + 12.0, y + 18.0) } else { (y + 15.5, y) };
            let (name_x, anchor) = if narrow { (4.0, "start") } else { (left - 8.0, "end") };
            svg.push_str(&text(name_x, name_y, &format!("text-anchor=\"{anchor}\""), &bar.name));
            let length = (right - left).max(1.0) * bar.value.max(0.0) / greatest;
            svg.push_str(&format!(
                "<rect x=\"{left:.1}\" y=\"{bar_y:.1}\" width=\"{length:.1}\" height=\"22\" fill=\"{}\"><title>{}</title></rect>\n",
                bar.colour,
                escaped(&format!("{}: {}", bar.name, bar.text))
            ));
            svg.push_str(&text(left + length + 7.0, bar_y + 15.5, "", &bar.text));
        }
        if !narrow {
            svg.push_str(&format!("<path d=\"M{left:.1} {top:.1}V{:.1}\" stroke=\"{GREY}\"/>\n", size.height - 6.0));
        }
        svg + "</svg>\n"
    }
}
