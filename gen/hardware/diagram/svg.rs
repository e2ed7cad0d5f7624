//! A picture as SVG, self-contained: clocks as columns, registers on their borders.

use super::label::Kind;
use super::layout::{Layout, Net};
use super::model::Picture;
use std::fmt::Write;

const CHARACTER: f64 = 6.3;
const MARGIN: f64 = 24.0;
const TOP: f64 = 104.0;
/// Room for the registers at the end of a clock, and for lines to change their height.
const REGISTERS: f64 = 26.0;
const BEND: f64 = 44.0;
const RED: &str = "#d55e00";

/// Left end, width and right end of the space behind each layer.
struct Columns {
    left: Vec<f64>,
    width: Vec<f64>,
    end: Vec<f64>,
}

impl Columns {
    /// Where the registers at the end of a layer's clock stand.
    fn border(&self, layer: usize, label: f64) -> f64 {
        self.left[layer] + self.width[layer] + label + REGISTERS / 2.0
    }
}

struct Drawing<'a> {
    picture: &'a Picture,
    layout: Layout,
    columns: Columns,
    /// Room for formats behind each layer.
    labels: Vec<f64>,
    out: String,
}

impl Picture {
    /// The picture as SVG.
    pub fn svg(&self) -> String {
        let layout = Layout::new(self);
        let labels = labels(&layout);
        let columns = columns(self, &layout, &labels);
        Drawing { picture: self, layout, columns, labels, out: String::new() }.draw()
    }
}

fn width_of(text: &str) -> f64 {
    text.chars().count() as f64 * CHARACTER
}

fn labels(layout: &Layout) -> Vec<f64> {
    let mut labels = vec![0.0f64; layout.clock_of.len()];
    for net in &layout.nets {
        let layer = layout.items[net.from].layers.1;
        labels[layer] = labels[layer].max(width_of(&net.label) * 0.86 + 8.0);
    }
    labels
}

fn columns(picture: &Picture, layout: &Layout, labels: &[f64]) -> Columns {
    let layers = layout.clock_of.len();
    let mut width = vec![40.0f64; layers];
    for (place, item) in picture.places.iter().zip(&layout.items) {
        let text = width_of(&place.name).max(width_of(&place.operation)) + 14.0;
        if item.layers.0 == item.layers.1 {
            width[item.layers.0] = width[item.layers.0].max(text);
        } else {
            let (a, b) = item.layers;
            width[a] = width[a].max((text / (b - a + 1) as f64).max(text - 90.0 * (b - a) as f64));
        }
    }
    let (mut left, mut end) = (vec![], vec![]);
    let mut x = MARGIN + 12.0;
    for layer in 0..layers {
        left.push(x);
        let border = layout.clock_of.get(layer + 1).is_none_or(|next| *next != layout.clock_of[layer]);
        x += width[layer] + labels[layer] + if border { REGISTERS } else { 0.0 };
        x += if layer + 1 < layers { BEND } else { 0.0 };
        end.push(x);
    }
    Columns { left, width, end }
}

impl Drawing<'_> {
    fn draw(mut self) -> String {
        let layers = self.layout.clock_of.len();
        let bottom = self.layout.items.iter().map(|i| i.y + i.height / 2.0).fold(0.0, f64::max) + TOP;
        let titles = width_of(&self.picture.what).max(width_of(&self.picture.longest) + 160.0) * 1.1 + 2.0 * MARGIN;
        let width = (self.columns.end[layers - 1] + MARGIN).max(titles).max(760.0).ceil();
        let height = (bottom + 70.0).ceil();
        let _ = writeln!(
            self.out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" font-size=\"10.5\">"
        );
        let _ =
            writeln!(self.out, "<title>{}</title>", escaped(&format!("{}: {}", self.picture.name, self.picture.what)));
        self.out += "<defs>\n";
        for (id, colour) in [("arrow", "#444444"), ("red-arrow", RED)] {
            let _ = writeln!(
                self.out,
                "<marker id=\"{id}\" viewBox=\"0 0 8 8\" refX=\"7.5\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" \
                 markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0,0.8 L8,4 L0,7.2 z\" fill=\"{colour}\"/></marker>"
            );
        }
        let _ = writeln!(self.out, "</defs>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>");
        self.clocks(bottom + 14.0);
        self.title();
        for place in 0..self.picture.places.len() {
            self.late(place);
        }
        // The critical path is drawn last, over everything else.
        for critical in [false, true] {
            for net in self.layout.nets.clone() {
                self.net(&net, critical);
            }
        }
        for place in 0..self.picture.places.len() {
            self.place(place);
        }
        self.legend(bottom + 44.0);
        self.out + "</svg>\n"
    }

    fn text(&mut self, x: f64, y: f64, size: f64, style: &str, text: &str) {
        let _ =
            writeln!(self.out, "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\"{style}>{}</text>", escaped(text));
    }

    fn title(&mut self) {
        let picture = self.picture;
        self.text(MARGIN, 30.0, 18.0, " font-weight=\"bold\"", &picture.name);
        self.text(MARGIN, 48.0, 11.0, "", &picture.what);
        let clocks = match picture.latency {
            0 => "combinational".to_owned(),
            1 => "latency 1 clock".to_owned(),
            n => format!("latency {n} clocks"),
        };
        self.text(MARGIN, 64.0, 11.0, " fill=\"#555555\"", &format!("{clocks}, {}", picture.longest));
    }

    /// Bands of the clocks, with the borders between them.
    fn clocks(&mut self, bottom: f64) {
        let layers = self.layout.clock_of.len();
        let mut x = MARGIN;
        let mut first = 0;
        for layer in 0..layers {
            let clock = self.layout.clock_of[layer];
            if self.layout.clock_of.get(layer + 1).is_some_and(|next| *next == clock) {
                continue;
            }
            let end = if layer + 1 == layers {
                self.columns.end[layer]
            } else {
                self.columns.border(layer, self.labels[layer])
            };
            let colour = if (clock + 1000) % 2 == 0 { "#f6f7f9" } else { "#ffffff" };
            let _ = writeln!(
                self.out,
                "<rect x=\"{x:.1}\" y=\"76\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\"/>",
                end - x,
                bottom - 76.0
            );
            if layer + 1 < layers {
                let _ = writeln!(
                    self.out,
                    "<path d=\"M{end:.1},76 V{bottom:.1}\" stroke=\"#9aa3ad\" stroke-width=\"1\" stroke-dasharray=\"4 3\"/>"
                );
            }
            let middle = (self.columns.left[first].min(end) + end) / 2.0;
            self.text(middle, 91.0, 10.5, " text-anchor=\"middle\" fill=\"#555555\"", &format!("clock {clock}"));
            (x, first) = (end, layer + 1);
        }
    }

    /// The right end of a box or trunk.
    fn right(&self, item: usize) -> f64 {
        let layer = self.layout.items[item].layers.1;
        self.columns.left[layer] + self.columns.width[layer]
    }

    /// Where lines may begin to bend behind a layer.
    fn bend(&self, layer: usize) -> f64 {
        self.columns.end[layer] - BEND
    }

    /// Draws a value: its common stem, then a branch to each use. The critical path comes in a pass of its own.
    fn net(&mut self, net: &Net, critical: bool) {
        let picture = self.picture;
        let edges: Vec<usize> = net.edges.iter().copied().filter(|e| picture.edges[*e].critical == critical).collect();
        let layer = |e: &usize| self.layout.items[picture.edges[*e].to].layers.0;
        let Some(furthest) = edges.iter().map(layer).max() else { return };
        let next = self.layout.items[net.from].layers.1 + 1;
        let (pin, right, bend) = (self.layout.pin_y(net) + TOP, self.right(net.from), self.bend(next - 1));
        let trunk = net.trunk.filter(|_| furthest > next).map(|trunk| self.layout.items[trunk].y + TOP);
        let mut paths = vec![(format!("M{right:.1},{pin:.1} H{bend:.1}"), false)];
        if let Some(y) = trunk {
            paths[0].0 += &curve(bend, pin, self.columns.left[next], y);
            let _ = write!(paths[0].0, " H{:.1}", self.bend(furthest - 1));
        }
        for e in &edges {
            let to = picture.edges[*e].to;
            let (layer, entry) = (layer(e), self.layout.entry_y(to, *e) + TOP);
            let (x, y) = (self.bend(layer - 1), trunk.filter(|_| layer > next).unwrap_or(pin));
            paths.push((format!("M{x:.1},{y:.1}{}", curve(x, y, self.columns.left[layer], entry)), true));
        }
        let (colour, width, arrow) = if critical { (RED, 2.6, "red-arrow") } else { ("#444444", 1.0, "arrow") };
        for (path, ends) in paths {
            let arrow = if ends { format!(" marker-end=\"url(#{arrow})\"") } else { String::new() };
            let _ = writeln!(
                self.out,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{arrow}/>"
            );
        }
        let any_critical = net.edges.iter().any(|e| picture.edges[*e].critical);
        if critical == any_critical {
            self.registers(net);
            let colour = if any_critical { RED } else { "#1f4e79" };
            self.text(right + 4.0, pin - 3.0, 9.0, &format!(" fill=\"{colour}\""), &net.label);
        }
    }

    /// The registers of a value, on the borders of the clocks it passes.
    fn registers(&mut self, net: &Net) {
        let place = &self.picture.places[net.from];
        let behind = place.start..if place.kind == Kind::Instance { place.start } else { place.from };
        let last = self.layout.items[net.from].layers.1;
        let furthest =
            net.edges.iter().map(|e| self.layout.items[self.picture.edges[*e].to].layers.0).max().unwrap_or(0);
        for layer in last..furthest {
            let clock = self.layout.clock_of[layer];
            if self.layout.clock_of[layer + 1] == clock {
                continue;
            }
            let held = net.edges.iter().any(|e| {
                let edge = &self.picture.edges[*e];
                let start = self.picture.places[edge.to].start;
                clock < start && clock >= start - edge.registers
            });
            if held || behind.contains(&clock) {
                let x = self.columns.border(layer, self.labels[layer]);
                let y = TOP + if layer == last { self.layout.pin_y(net) } else { self.layout.source_y(net, layer + 1) };
                let _ = writeln!(
                    self.out,
                    "<path d=\"M{:.1},{:.1} h8 v12 h-8 z m0,9 l4,-3.5 l4,3.5\" fill=\"#ffffff\" stroke=\"#222222\"/>",
                    x - 4.0,
                    y - 6.0
                );
            }
        }
    }

    /// Values that come from a later place of the picture: the name of where they come from.
    fn late(&mut self, to: usize) {
        let picture = self.picture;
        let item = self.layout.items[to].clone();
        let edges = picture.edges.iter().filter(|e| e.to == to && e.late);
        for (i, edge) in edges.enumerate() {
            let text = format!("from {}, an interval ago", picture.places[edge.from].name);
            let y = item.y + TOP + item.height / 2.0 + 9.0 * (i + 1) as f64;
            self.text(self.columns.left[item.layers.0], y, 8.0, " fill=\"#555555\" font-style=\"italic\"", &text);
        }
    }

    fn place(&mut self, i: usize) {
        let place = &self.picture.places[i];
        let item = self.layout.items[i].clone();
        let (left, right) = (self.columns.left[item.layers.0], self.right(i));
        let (top, middle) = (item.y + TOP - item.height / 2.0, (left + right) / 2.0);
        let (stroke, width) = if place.critical { (RED, 2.6) } else { ("#333333", 1.0) };
        let round = if place.kind == Kind::Port { item.height / 2.0 } else { 4.0 };
        let _ = writeln!(
            self.out,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"{:.1}\" fill=\"{}\" stroke=\"{stroke}\" \
             stroke-width=\"{width}\"/>",
            right - left,
            item.height,
            round.min(17.0),
            place.kind.colour()
        );
        let y = item.y + TOP;
        let port = place.kind == Kind::Port;
        let name = if port { y + 3.5 } else { y - 3.0 };
        self.text(middle, name, 10.5, " text-anchor=\"middle\" font-weight=\"bold\"", &place.name);
        if !port {
            self.text(middle, y + 10.5, 10.0, " text-anchor=\"middle\"", &place.operation);
        }
    }

    fn legend(&mut self, y: f64) {
        let mut x = MARGIN;
        for kind in Kind::ALL {
            if !self.picture.places.iter().any(|p| p.kind == kind) {
                continue;
            }
            let _ = writeln!(
                self.out,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"14\" height=\"12\" rx=\"3\" fill=\"{}\" stroke=\"#333333\"/>",
                y - 10.0,
                kind.colour()
            );
            self.text(x + 19.0, y, 10.5, "", kind.name());
            x += 34.0 + width_of(kind.name());
        }
        let _ = writeln!(
            self.out,
            "<path d=\"M{:.1},{:.1} h8 v12 h-8 z m0,9 l4,-3.5 l4,3.5\" fill=\"#ffffff\" stroke=\"#222222\"/>",
            x + 2.0,
            y - 10.0
        );
        self.text(x + 16.0, y, 10.5, "", "register");
        x += 34.0 + width_of("register");
        let _ = writeln!(self.out, "<path d=\"M{x:.1},{:.1} h22\" stroke=\"{RED}\" stroke-width=\"2.6\"/>", y - 4.0);
        self.text(x + 27.0, y, 10.5, "", "critical path");
    }
}

/// A line that changes its height between two places.
fn curve(from: f64, y: f64, to: f64, entry: f64) -> String {
    if (y - entry).abs() < 0.5 {
        return format!(" H{to:.1}");
    }
    let middle = (from + to) / 2.0;
    format!(" C{middle:.1},{y:.1} {middle:.1},{entry:.1} {to:.1},{entry:.1}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
