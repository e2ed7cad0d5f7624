//! What is to be seen of a schedule: boxes in clocks, and the values between them.

use super::critical;
use super::label::{self, Kind};
use crate::graph::{Op, Rate};
use crate::op::{Comb, Type};
use crate::schedule::{Schedule, Slot};
use std::collections::HashSet;

/// A box.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Name of the node.
    pub name: String,
    /// What it computes.
    pub operation: String,
    /// Its kind.
    pub kind: Kind,
    /// Clock in which its operands are consumed.
    pub start: i32,
    /// Clock in which its value is first there.
    pub from: i32,
    /// Arrival of its value in that clock, ns after the edge.
    pub ns: f64,
    /// Whether it lies on the critical path.
    pub critical: bool,
}

/// A value on its way from a box to another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Box it comes from.
    pub from: usize,
    /// Box it goes to.
    pub to: usize,
    /// Name of the output, where the box is an instance with several.
    pub port: String,
    /// Format.
    pub format: String,
    /// Registers on the way.
    pub registers: i32,
    /// Whether it is read an interval or more later, by a phase that comes before it in the picture.
    pub late: bool,
    /// Whether it lies on the critical path.
    pub critical: bool,
}

/// A block as a picture.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Name of the block.
    pub name: String,
    /// What it is, one line.
    pub what: String,
    /// Clocks from inputs to outputs.
    pub latency: i32,
    /// The longest path between registers in words.
    pub longest: String,
    /// Boxes.
    pub places: Vec<Place>,
    /// Edges, by the box they go to.
    pub edges: Vec<Edge>,
}

impl Picture {
    /// The picture of a scheduled block for a clock of `period` ns.
    pub fn new(schedule: &Schedule, period: f64) -> Self {
        Maker::new(schedule).picture(period)
    }

    /// The first and the last clock.
    pub fn clocks(&self) -> (i32, i32) {
        let first = self.places.iter().map(|p| p.start).min().unwrap_or(0);
        (first, self.places.iter().map(|p| p.from).max().unwrap_or(0).max(self.latency))
    }
}

struct Maker<'a> {
    schedule: &'a Schedule,
    path: HashSet<usize>,
    /// The box of each node, where it has one.
    boxes: Vec<Option<usize>>,
    picture: Picture,
}

impl<'a> Maker<'a> {
    fn new(schedule: &'a Schedule) -> Self {
        let block = &schedule.block;
        let picture = Picture {
            name: block.name.clone(),
            what: first_sentence(&block.doc),
            latency: schedule.latency,
            longest: String::new(),
            places: vec![],
            edges: vec![],
        };
        let path = critical::path(schedule).into_iter().collect();
        Self { schedule, path, boxes: vec![None; block.nodes.len()], picture }
    }

    fn picture(mut self, period: f64) -> Picture {
        let block = &self.schedule.block;
        let shown: Vec<usize> = (0..block.nodes.len()).filter(|i| self.shown(*i)).collect();
        for i in &shown {
            self.boxes[*i] = Some(self.picture.places.len());
            let slot = self.schedule.slots[*i];
            let (kind, operation) = label::operation(block, *i);
            let place = Place {
                name: block.nodes[*i].name(),
                operation,
                kind,
                start: if slot.start == i32::MIN { 0 } else { slot.start },
                from: if slot.from == i32::MIN { 0 } else { slot.from },
                ns: slot.ns,
                critical: self.path.contains(i),
            };
            self.picture.places.push(place);
        }
        for i in &shown {
            let node = &block.nodes[*i];
            let start = self.schedule.slots[*i].start;
            let registered = self.schedule.slots[*i].registered && !matches!(node.op, Op::Mux { .. });
            for (place, arg) in node.args.iter().enumerate() {
                let late = matches!(&node.op, Op::Mux { late } if place > 0 && late[place - 1]);
                self.edge(arg.0, *i, start, registered, late);
            }
        }
        for (name, node) in &block.outputs {
            let to = self.picture.places.len();
            let (latency, ns) = (self.schedule.latency, 0.0);
            let (name, operation) = (name.to_string(), "output".to_owned());
            let (start, from, kind, critical) = (latency, latency, Kind::Port, false);
            self.picture.places.push(Place { name, operation, kind, start, from, ns, critical });
            self.connect(node.0, to, latency, false, false, false);
        }
        let (ns, at) = &self.schedule.critical;
        self.picture.longest = format!("longest path {ns:.2} ns of {period:.2} ns, to {at}");
        self.picture
    }

    /// Whether a node has a box: constants, patterns of phases and what costs nothing have none.
    fn shown(&self, i: usize) -> bool {
        let block = &self.schedule.block;
        let hidden =
            matches!(block.nodes[i].op, Op::Comb(Comb::Constant(_) | Comb::Resize(_)) | Op::Phase(_) | Op::Output(_));
        !hidden && !block.renames(i)
    }

    /// The node that has the box of node `i`, and the outputs and resizes on the way to it.
    fn carrier(&self, mut i: usize) -> (usize, Type, String) {
        let block = &self.schedule.block;
        let ty = block.nodes[i].ty;
        let mut port = String::new();
        while !self.shown(i) && !block.nodes[i].args.is_empty() {
            let node = &block.nodes[i];
            if let (Op::Output(k), Op::Instance(child)) = (&node.op, &block.node(node.args[0]).op) {
                port = child.outputs[*k].0.to_string();
            }
            i = node.args[0].0;
        }
        (i, ty, port)
    }

    fn edge(&mut self, from: usize, to: usize, start: i32, registered: bool, late: bool) {
        let critical = self.path.contains(&from) && self.path.contains(&to);
        let Some(to) = self.boxes[to] else { return };
        self.connect(from, to, start, registered, late, critical);
    }

    fn connect(&mut self, from: usize, to: usize, start: i32, registered: bool, late: bool, critical: bool) {
        let (carrier, ty, port) = self.carrier(from);
        let Some(place) = self.boxes[carrier] else { return };
        let slot = self.schedule.slots[from];
        let rate = self.schedule.block.nodes[from].rate;
        let registers = if late { 0 } else { registers(slot, rate, start, registered, self.schedule.block.interval) };
        let critical = critical && registers == 0;
        let edge = Edge { from: place, to, port, format: ty.to_string(), registers, late, critical };
        if !self
            .picture
            .edges
            .iter()
            .any(|known| (known.from, known.to, &known.port) == (edge.from, edge.to, &edge.port))
        {
            self.picture.edges.push(edge);
        }
    }
}

/// The first sentence of a description, or what stands before its first colon.
fn first_sentence(doc: &[String]) -> String {
    let paragraph: Vec<&str> = doc.iter().map(|line| line.trim()).take_while(|line| !line.is_empty()).collect();
    let text = paragraph.join(" ");
    let end = [". ", ": "].iter().filter_map(|mark| text.find(mark)).min();
    end.map_or(text.clone(), |end| format!("{}.", &text[..end]))
}

/// Registers between a value and a use of it that starts in a clock.
fn registers(slot: Slot, rate: Rate, start: i32, registered: bool, interval: usize) -> i32 {
    if slot.from == i32::MIN {
        0
    } else if slot.until == i32::MAX || rate == Rate::Phase {
        (start - slot.from).max(0)
    } else if start < slot.until {
        i32::from(registered && start > slot.from)
    } else {
        // Captured again once an interval.
        (start - slot.until) / interval.max(1) as i32 + 1
    }
}
