//! A picture for Graphviz: one cluster a clock.

use super::model::{Kind, Picture, Place};
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
            if edge.lagged {
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
    /// All kinds.
    pub const ALL: [Self; 8] =
        [Self::Port, Self::Product, Self::Sum, Self::Comparison, Self::Choice, Self::Logic, Self::Wire, Self::Instance];

    /// The colour of its boxes: tints of Okabe and Ito's palette, which the colour-blind tell apart.
    pub fn colour(self) -> &'static str {
        match self {
            Self::Port => "#ffffff",
            Self::Product => "#f5cf80",
            Self::Sum => "#a9d6f2",
            Self::Comparison => "#8fd1bd",
            Self::Choice => "#e3bdd1",
            Self::Logic => "#d4d4d4",
            Self::Wire => "#f0f0f0",
            Self::Instance => "#f7f1a8",
        }
    }

    /// Its name in a legend.
    pub fn name(self) -> &'static str {
        match self {
            Self::Port => "port",
            Self::Product => "product",
            Self::Sum => "sum",
            Self::Comparison => "comparison",
            Self::Choice => "choice",
            Self::Logic => "logic",
            Self::Wire => "wires",
            Self::Instance => "instance",
        }
    }
}
