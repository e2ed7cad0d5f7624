//! A picture for Graphviz: one cluster per clock.

use super::label::Kind;
use super::model::{Picture, Place};
use crate::op;
use std::collections::BTreeMap;
use std::fmt::Write;

impl Picture {
    /// The graph in the DOT language; `dot -Tsvg` draws it.
    pub fn dot(&self) -> String {
        let mut out = format!("digraph {} {{\n", quoted(&self.name));
        let title = format!("{}: {}\n{} clocks, {}", self.name, self.what, self.latency, self.longest);
        out += "  rankdir=LR; nodesep=0.15; ranksep=0.5; fontname=\"Helvetica\"; labelloc=t;\n";
        let _ = writeln!(out, "  label={};", quoted(&title));
        out += "  node [shape=box, style=\"filled\", fontname=\"Helvetica\", fontsize=10, margin=\"0.08,0.04\"];\n";
        out += "  edge [fontname=\"Helvetica\", fontsize=8, arrowsize=0.6];\n";
        let mut clocks: BTreeMap<i32, Vec<usize>> = BTreeMap::new();
        for (i, place) in self.places.iter().enumerate() {
            clocks.entry(place.start).or_default().push(i);
        }
        for (clock, members) in clocks {
            let _ = writeln!(out, "  subgraph cluster_clock_{} {{", clock.to_string().replace('-', "minus_"));
            let _ = writeln!(out, "    label=\"clock {clock}\"; style=filled; color=\"#f2f2f2\";");
            for i in members {
                let _ = writeln!(out, "    n{i} [{}];", attributes(&self.places[i]));
            }
            out += "  }\n";
        }
        for edge in &self.edges {
            let mut label = format!("{} {}", edge.port, edge.format).trim().to_owned();
            if edge.registers > 0 {
                let _ = write!(label, "\n{} reg", edge.registers);
            }
            let mut style = format!("label={}", quoted(&label));
            if edge.critical {
                style += ", color=\"#d55e00\", penwidth=2.5";
            }
            if edge.late {
                style += ", style=dashed, constraint=false";
            }
            let _ = writeln!(out, "  n{} -> n{} [{style}];", edge.from, edge.to);
        }
        out + "}\n"
    }
}

fn attributes(place: &Place) -> String {
    let label = format!("{}\n{}", place.name, place.operation);
    let mut text = format!("label={}, fillcolor=\"{}\"", quoted(&label), place.kind.colour());
    if place.critical {
        text += ", color=\"#d55e00\", penwidth=2.5";
    }
    text
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}

impl Kind {
    /// All kinds, in the order of the legend.
    pub const ALL: [Self; 9] = [
        Self::Port,
        Self::Operation(op::Kind::Product),
        Self::Operation(op::Kind::Sum),
        Self::Operation(op::Kind::Comparison),
        Self::Operation(op::Kind::Multiplexer),
        Self::Operation(op::Kind::Logic),
        Self::Operation(op::Kind::Wire),
        Self::Sharing,
        Self::Instance,
    ];

    /// Its fill colour, of tints of Okabe and Ito's palette that the colour-blind tell apart, and its name.
    fn style(self) -> (&'static str, &'static str) {
        match self {
            Self::Port => ("#ffffff", "port"),
            Self::Operation(op::Kind::Product) => ("#f5cf80", "product"),
            Self::Operation(op::Kind::Sum) => ("#a9d6f2", "sum"),
            Self::Operation(op::Kind::Comparison) => ("#8fd1bd", "comparison"),
            Self::Operation(op::Kind::Multiplexer) => ("#e3bdd1", "multiplexer"),
            Self::Operation(op::Kind::Logic) => ("#d4d4d4", "logic"),
            Self::Operation(op::Kind::Wire) => ("#f0f0f0", "wires"),
            Self::Sharing => ("#f2dce7", "time sharing"),
            Self::Instance => ("#f7f1a8", "instance"),
        }
    }

    /// Its fill colour.
    pub(super) fn colour(self) -> &'static str {
        self.style().0
    }

    /// Its name in the legend.
    pub(super) fn name(self) -> &'static str {
        self.style().1
    }
}
