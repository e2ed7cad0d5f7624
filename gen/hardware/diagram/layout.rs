//! Where everything stands: boxes and long values in layers, each clock one or several layers.
//!
//! A box takes one height through all layers it spans. So does a *trunk*: a value on its way to uses further on. Heights
//! are found greedily near the neighbours' and improved by sweeps; nothing is random.

use super::label::Kind;
use super::model::Picture;
use std::collections::BTreeMap;

/// Sweeps over all heights.
const SWEEPS: usize = 24;

/// Space kept free between two items of a layer, px.
const BETWEEN: f64 = 9.0;

/// Height of a box with few pins, of a trunk, and of one pin, px.
const BOX: f64 = 34.0;
const TRUNK: f64 = 11.0;
const OUT_PIN: f64 = 15.0;
const IN_PIN: f64 = 9.0;

/// A box or a trunk.
#[derive(Clone, Debug)]
pub(super) struct Item {
    /// First and last layer.
    pub layers: (usize, usize),
    /// Height.
    pub height: f64,
    /// Middle, downwards.
    pub y: f64,
}

/// A value: an output of a box with all its uses.
#[derive(Clone, Debug)]
pub(super) struct Net {
    /// Box it comes from.
    pub from: usize,
    /// Which of the box's outputs it is, and how many there are.
    pub pin: (usize, usize),
    /// Name and format.
    pub label: String,
    /// Edges of the picture.
    pub edges: Vec<usize>,
    /// The item that carries it on, where some use is further on than the next layer.
    pub trunk: Option<usize>,
}

/// All places and values, laid out.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// The boxes in the picture's order, then the trunks.
    pub items: Vec<Item>,
    /// Values.
    pub nets: Vec<Net>,
    /// The clock of each layer.
    pub clock_of: Vec<i32>,
    /// Of each box, its edges in the order of their pins, from the top.
    pub pins: Vec<Vec<usize>>,
}

impl Layout {
    /// Lays a picture out.
    pub fn new(picture: &Picture) -> Self {
        let (items, clock_of) = boxes(picture);
        let mut layout = Self { items, nets: vec![], clock_of, pins: vec![vec![]; picture.places.len()] };
        layout.add_nets(picture);
        layout.settle(picture);
        layout.sort_pins(picture);
        layout
    }

    fn add_nets(&mut self, picture: &Picture) {
        let mut by_port: BTreeMap<(usize, &str), Vec<usize>> = BTreeMap::new();
        for (e, edge) in picture.edges.iter().enumerate().filter(|(_, edge)| !edge.late) {
            by_port.entry((edge.from, &edge.port)).or_default().push(e);
            self.pins[edge.to].push(e);
        }
        let mut outputs = vec![0; picture.places.len()];
        for ((from, port), edges) in by_port {
            let next = self.items[from].layers.1 + 1;
            let last = edges.iter().map(|e| self.items[picture.edges[*e].to].layers.0).max().unwrap_or(next);
            let trunk = (last > next).then(|| {
                let y = 0.0;
                self.items.push(Item { layers: (next, last - 1), height: TRUNK, y });
                self.items.len() - 1
            });
            let label = format!("{port} {}", picture.edges[edges[0]].format).trim().to_owned();
            self.nets.push(Net { from, pin: (outputs[from], 0), label, edges, trunk });
            outputs[from] += 1;
        }
        for net in &mut self.nets {
            net.pin.1 = outputs[net.from];
        }
        for (i, item) in self.items.iter_mut().take(picture.places.len()).enumerate() {
            let pins = (outputs[i] as f64 * OUT_PIN).max(self.pins[i].len() as f64 * IN_PIN);
            item.height = BOX.max(pins + 6.0);
        }
    }

    /// Pairs of items that a line joins.
    fn links(&self, picture: &Picture) -> Vec<(usize, usize)> {
        let mut links = vec![];
        for net in &self.nets {
            let next = self.items[net.from].layers.1 + 1;
            links.extend(net.trunk.map(|trunk| (net.from, trunk)));
            for e in &net.edges {
                let to = picture.edges[*e].to;
                let near = self.items[to].layers.0 <= next;
                links.push((if near { net.from } else { net.trunk.unwrap_or(net.from) }, to));
            }
        }
        links
    }

    /// Finds the heights.
    fn settle(&mut self, picture: &Picture) {
        let links = self.links(picture);
        let mut neighbours = vec![vec![]; self.items.len()];
        let mut before = vec![vec![]; self.items.len()];
        for (a, b) in &links {
            neighbours[*a].push(*b);
            neighbours[*b].push(*a);
            before[*b].push(*a);
        }
        let mean = |items: &[Item], of: &[usize]| of.iter().map(|i| items[*i].y).sum::<f64>() / of.len() as f64;
        let mut best: Option<(f64, Vec<Item>)> = None;
        for sweep in 0..SWEEPS {
            let old = self.items.clone();
            let mut order: Vec<usize> = (0..self.items.len()).collect();
            // Inwards from both sides by turns, the well connected first.
            let backwards = sweep % 2 == 1;
            let wish = |items: &[Item], i: usize| match (sweep, before[i].is_empty(), neighbours[i].is_empty()) {
                (_, _, true) => items[i].y,
                (0, true, _) => i as f64 * (BOX + BETWEEN),
                (0, ..) => mean(items, &before[i]),
                _ => mean(items, &neighbours[i]),
            };
            let key = |i: usize| (if backwards { usize::MAX - old[i].layers.1 } else { old[i].layers.0 }, i);
            order.sort_by(|a, b| {
                key(*a).0.cmp(&key(*b).0).then(wish(&old, *a).total_cmp(&wish(&old, *b))).then(a.cmp(b))
            });
            let mut taken: Vec<Vec<(f64, f64)>> = vec![vec![]; self.clock_of.len()];
            for i in order {
                let wanted = wish(&self.items, i);
                self.items[i].y = free(&taken, &self.items[i], wanted);
                let item = &self.items[i];
                for layer in &mut taken[item.layers.0..=item.layers.1] {
                    layer.push((item.y - item.height / 2.0, item.y + item.height / 2.0));
                }
            }
            let length: f64 = links.iter().map(|(a, b)| (self.items[*a].y - self.items[*b].y).abs()).sum();
            if best.as_ref().is_none_or(|(least, _)| length < *least) {
                best = Some((length, self.items.clone()));
            }
        }
        self.items = best.map_or(vec![], |b| b.1);
        let top = self.items.iter().map(|i| i.y - i.height / 2.0).fold(f64::INFINITY, f64::min);
        self.items.iter_mut().for_each(|item| item.y = (item.y - top).round());
    }

    fn sort_pins(&mut self, picture: &Picture) {
        let mut height = vec![0.0; picture.edges.len()];
        for net in &self.nets {
            for e in &net.edges {
                height[*e] = self.source_y(net, self.items[picture.edges[*e].to].layers.0);
            }
        }
        for pins in &mut self.pins {
            pins.sort_by(|a, b| height[*a].total_cmp(&height[*b]).then(a.cmp(b)));
        }
    }

    /// The height of a value where it leaves its box.
    pub fn pin_y(&self, net: &Net) -> f64 {
        let item = &self.items[net.from];
        item.y + (net.pin.0 as f64 - (net.pin.1 as f64 - 1.0) / 2.0) * OUT_PIN
    }

    /// The height of a value just before a layer.
    pub fn source_y(&self, net: &Net, layer: usize) -> f64 {
        let near = layer <= self.items[net.from].layers.1 + 1;
        net.trunk.filter(|_| !near).map_or_else(|| self.pin_y(net), |trunk| self.items[trunk].y)
    }

    /// The height at which an edge enters its box.
    pub fn entry_y(&self, to: usize, edge: usize) -> f64 {
        let pins = &self.pins[to];
        let place = pins.iter().position(|e| *e == edge).unwrap_or(0) as f64;
        let step = (self.items[to].height - 8.0) / pins.len().max(1) as f64;
        self.items[to].y + (place - (pins.len() as f64 - 1.0) / 2.0) * step.min(14.0)
    }
}

/// The free height nearest to the wanted one.
fn free(taken: &[Vec<(f64, f64)>], item: &Item, wanted: f64) -> f64 {
    let half = item.height / 2.0 + BETWEEN;
    let walls: Vec<(f64, f64)> = (item.layers.0..=item.layers.1).flat_map(|l| taken[l].iter().copied()).collect();
    let fits = |y: f64| walls.iter().all(|(top, bottom)| y + half <= *top + 1e-6 || y - half >= *bottom - 1e-6);
    let beside = walls.iter().flat_map(|(top, bottom)| [top - half, bottom + half]);
    let nearest = |a: &f64, b: &f64| (a - wanted).abs().total_cmp(&(b - wanted).abs()).then(a.total_cmp(b));
    std::iter::once(wanted).chain(beside).filter(|y| fits(*y)).min_by(nearest).unwrap_or(wanted)
}

/// The boxes in their layers, and the clock of each layer.
fn boxes(picture: &Picture) -> (Vec<Item>, Vec<i32>) {
    let places = &picture.places;
    let (first, last) = picture.clocks();
    let mut level = vec![0usize; places.len()];
    // Boxes come in the order of computation, so one pass finds the levels within each clock.
    for to in 0..places.len() {
        let inside = |e: &&super::Edge| {
            let from = &places[e.from];
            e.to == to && !e.late && from.start == from.from && from.from == places[to].start
        };
        level[to] = picture.edges.iter().filter(inside).map(|e| level[e.from] + 1).max().unwrap_or(0);
    }
    let mut depth: BTreeMap<i32, usize> = (first..=last).map(|clock| (clock, 1)).collect();
    for (place, level) in places.iter().zip(&level) {
        let levels = depth.entry(place.start).or_insert(1);
        *levels = (*levels).max(level + 1);
    }
    let mut start = BTreeMap::new();
    let mut clock_of = vec![];
    for (clock, levels) in &depth {
        start.insert(*clock, clock_of.len());
        clock_of.extend(std::iter::repeat_n(*clock, *levels));
    }
    let end = clock_of.len() - 1;
    let item = |(place, level): (&super::Place, &usize)| {
        let from = start[&place.start] + level;
        // An instance spans the clocks it takes; registers behind any other box stand on the borders.
        let to = if place.kind == Kind::Instance && place.from > place.start {
            start.get(&place.from).map_or(end, |s| s - 1)
        } else {
            from
        };
        let output = place.operation == "output";
        Item { layers: if output { (end, end) } else { (from, to.max(from)) }, height: BOX, y: 0.0 }
    };
    (places.iter().zip(&level).map(item).collect(), clock_of)
}
