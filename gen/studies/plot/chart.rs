//! Points and lines over two axes.

use super::labels::{Places, Rectangle};
use super::scale::{Axis, Scale};
use super::{BLACK, CHART, GREY, Size, begin, escaped, text, text_width};

/// Shapes of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Circle,
    Square,
    Diamond,
    Triangle,
    Hollow,
    None,
}

/// How points are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    None,
    Solid,
    Dashed,
}

/// How a series looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub colour: &'static str,
    pub mark: Mark,
    pub line: Line,
}

/// A point; `bounds` are those of y, `about` is shown where the pointer rests.
#[derive(Clone, Debug, PartialEq)]
pub struct Dot {
    pub x: f64,
    pub y: f64,
    pub bounds: Option<[f64; 2]>,
    pub about: String,
}

/// Points that belong together; one without a name is not in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub name: String,
    pub style: Style,
    pub dots: Vec<Dot>,
}

/// A point with a label, ringed if it is to be found at once; without a text it gets a small ring alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    pub x: f64,
    pub y: f64,
    pub text: String,
    pub ring: bool,
}

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    pub title: String,
    pub about: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
    pub labels: Vec<Label>,
    /// What is written at the strip of points with y = 0 below a logarithmic axis.
    pub none: String,
}

/// Height of that strip.
const STRIP: f64 = 34.0;
/// Size of labels and legend.
const SMALL: f64 = 12.5;

impl Chart {
    /// The chart as a picture.
    pub fn svg(&self) -> String {
        let size = CHART;
        let (mut svg, top) = begin(size, &self.title, &self.about);
        let top = self.legend(&mut svg, size, top);
        let strip = self.y.logarithmic && self.series.iter().flat_map(|s| &s.dots).any(|dot| dot.y <= 0.0);
        svg.push_str(&text(4.0, top + 14.0, &format!("fill=\"{GREY}\" font-size=\"{SMALL}\""), &self.y.label));
        let (left, right) = (64.0, size.width - 14.0);
        let (top, bottom) = (top + 26.0, size.height - 46.0);
        let floor = if strip { bottom - STRIP } else { bottom };
        let dots = || self.series.iter().flat_map(|series| &series.dots);
        let x = Scale::new(&self.x, dots().map(|dot| dot.x), [left, right]);
        let bounds =
            dots().flat_map(|dot| dot.bounds.into_iter().flatten().filter(|b| *b > 0.0 || !self.y.logarithmic));
        let least = dots().map(|dot| dot.y).filter(|y| *y > 0.0).fold(f64::INFINITY, f64::min);
        // A bound far below all points would squeeze them together.
        let bounds = bounds.filter(|b| !self.y.logarithmic || *b > least / 3.0);
        let y = Scale::new(&self.y, dots().map(|dot| dot.y).chain(bounds), [floor, top]);
        let level = |value: f64| if strip && value <= 0.0 { bottom - STRIP / 2.0 } else { y.at(value) };

        for tick in y.ticks(46.0) {
            let at = tick.at;
            svg.push_str(&format!("<path d=\"M{left} {at:.1}H{right}\" stroke=\"#e3e3e3\"/>\n"));
            svg.push_str(&text(left - 7.0, at + 4.0, "text-anchor=\"end\"", &tick.text));
        }
        for tick in x.ticks(64.0) {
            let at = tick.at;
            svg.push_str(&format!("<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"#efefef\"/>\n"));
            // The last number must not stick out.
            let room = size.width - 2.0 - text_width(&tick.text, 13.0) / 2.0;
            svg.push_str(&text(at.min(room), bottom + 18.0, "text-anchor=\"middle\"", &tick.text));
        }
        if strip {
            svg.push_str(&format!(
                "<path d=\"M{left} {floor:.1}H{right}\" stroke=\"#b5b5b5\" stroke-dasharray=\"3 4\"/>\n"
            ));
            let middle = bottom - STRIP / 2.0;
            svg.push_str(&text(left - 7.0, middle + 4.0, "text-anchor=\"end\"", &self.none));
        }
        svg.push_str(&format!("<path d=\"M{left} {bottom}H{right}\" stroke=\"{GREY}\"/>\n"));
        let middle = (left + right) / 2.0;
        let style = format!("text-anchor=\"middle\" fill=\"{GREY}\" font-size=\"{SMALL}\"");
        svg.push_str(&text(middle, bottom + 38.0, &style, &self.x.label));

        let mut places = Places::new(Rectangle([left, top - 4.0, right, bottom]));
        for series in &self.series {
            let at: Vec<[f64; 2]> = series.dots.iter().map(|dot| [x.at(dot.x), level(dot.y)]).collect();
            svg.push_str(&joined(&at, series.style));
            for (dot, at) in series.dots.iter().zip(&at) {
                if let Some([low, high]) = dot.bounds {
                    let low = if low > 0.0 || !self.y.logarithmic { y.at(low).min(floor) } else { floor };
                    let colour = series.style.colour;
                    svg.push_str(&format!(
                        "<path d=\"M{:.1} {low:.1}V{:.1}\" stroke=\"{colour}\" stroke-opacity=\"0.45\"/>\n",
                        at[0],
                        y.at(high)
                    ));
                }
                svg.push_str(&mark(*at, series.style, &dot.about));
                places.mark(*at, 4.5);
            }
            for pair in at.windows(2).filter(|_| series.style.line != Line::None) {
                along(pair[0], pair[1]).for_each(|p| places.mark(p, 2.5));
            }
        }
        for label in &self.labels {
            let at = [x.at(label.x), level(label.y)];
            if label.ring {
                let [x, y] = at;
                let radius = if label.text.is_empty() { 6.5 } else { 9.0 };
                svg.push_str(&format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"none\" stroke=\"{BLACK}\" stroke-width=\"2\"/>\n"
                ));
                places.mark(at, radius + 1.0);
            }
        }
        for label in self.labels.iter().filter(|label| !label.text.is_empty()) {
            let at = [x.at(label.x), level(label.y)];
            let weight = if label.ring { "font-weight=\"650\" " } else { "" };
            let width = if label.ring { 1.06 } else { 1.0 } * text_width(&label.text, SMALL);
            if let Some(Rectangle([left, top, right, bottom])) = places.find(at, width, SMALL + 3.0) {
                let near = [at[0].clamp(left, right), at[1].clamp(top, bottom)];
                if (near[0] - at[0]).hypot(near[1] - at[1]) > 16.0 {
                    let ([x, y], [to_x, to_y]) = (at, near);
                    svg.push_str(&format!("<path d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\" stroke=\"{GREY}\"/>\n"));
                }
                let base = bottom - 0.25 * (SMALL + 3.0);
                // A rim of its own below: not every program knows an order of painting.
                for rim in [" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\"", ""] {
                    svg.push_str(&text(left, base, &format!("{weight}font-size=\"{SMALL}\"{rim}"), &label.text));
                }
            }
        }
        svg + "</svg>\n"
    }

    /// Draws the legend, in rows; gives the height that is taken then.
    fn legend(&self, svg: &mut String, size: Size, top: f64) -> f64 {
        let (mut x, mut y) = (4.0, top + 10.0);
        for series in self.series.iter().filter(|series| !series.name.is_empty()) {
            let width = 30.0 + text_width(&series.name, SMALL) + 16.0;
            if x > 4.0 && x + width - 16.0 > size.width {
                (x, y) = (4.0, y + 19.0);
            }
            svg.push_str(&joined(&[[x, y - 4.0], [x + 22.0, y - 4.0]], series.style));
            svg.push_str(&mark([x + 11.0, y - 4.0], series.style, &series.name));
            svg.push_str(&text(x + 29.0, y, &format!("font-size=\"{SMALL}\""), &series.name));
            x += width;
        }
        y + 10.0
    }
}

/// Points on the way from one to another.
fn along(from: [f64; 2], to: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / 8.0).ceil().max(1.0);
    (0..=steps as u32).map(move |i| [0, 1].map(|k| from[k] + (to[k] - from[k]) * f64::from(i) / steps))
}

/// The line through points.
fn joined(at: &[[f64; 2]], style: Style) -> String {
    let dash = match style.line {
        Line::None => return String::new(),
        Line::Solid => "",
        Line::Dashed => " stroke-dasharray=\"5 4\"",
    };
    let path: Vec<String> = at.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
    if path.is_empty() {
        return String::new();
    }
    let colour = style.colour;
    format!("<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"{dash}/>\n", path.join("L"))
}

/// A point's shape.
fn mark([x, y]: [f64; 2], style: Style, about: &str) -> String {
    let path = |corners: &[[f64; 2]]| {
        let corners: Vec<String> = corners.iter().map(|c| format!("{:.1} {:.1}", x + c[0], y + c[1])).collect();
        format!("<path d=\"M{}Z\"", corners.join("L"))
    };
    let fill = if style.mark == Mark::Hollow { "#ffffff" } else { style.colour };
    let shape = match style.mark {
        Mark::None => return String::new(),
        Mark::Circle => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.6\""),
        Mark::Square | Mark::Hollow => path(&[[-3.6, -3.6], [3.6, -3.6], [3.6, 3.6], [-3.6, 3.6]]),
        Mark::Diamond => path(&[[0.0, -4.8], [4.8, 0.0], [0.0, 4.8], [-4.8, 0.0]]),
        Mark::Triangle => path(&[[0.0, -4.6], [4.4, 3.4], [-4.4, 3.4]]),
    };
    let rim = if style.mark == Mark::Hollow { style.colour } else { "#ffffff" };
    let width = if style.mark == Mark::Hollow { 1.8 } else { 0.6 };
    format!(
        "{shape} fill=\"{fill}\" stroke=\"{rim}\" stroke-width=\"{width}\"><title>{}</title></{}>\n",
        escaped(about),
        element(&shape)
    )
}

fn element(shape: &str) -> &'static str {
    if shape.starts_with("<circle") { "circle" } else { "path" }
}
