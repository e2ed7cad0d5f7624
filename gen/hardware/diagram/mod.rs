//! Pictures of a scheduled unit: clocks as columns, formats on the edges, the critical path marked.
//!
//! [`Picture::new`] takes from a schedule what is to be seen, [`Picture::dot`] writes it for Graphviz, [`Picture::svg`]
//! lays it out and draws it. Equal schedules give equal bytes.

mod critical;
mod dot;
mod label;
mod layout;
mod model;
mod svg;

#[cfg(test)]
mod tests;

pub use label::Kind;
pub use model::{Edge, Picture, Place};

use crate::graph::{Op, Unit};
use std::collections::HashSet;
use std::rc::Rc;

/// A unit and all units in it, each once, inner ones first.
pub fn units(unit: &Rc<Unit>) -> Vec<Rc<Unit>> {
    fn visit(unit: &Rc<Unit>, seen: &mut HashSet<*const Unit>, order: &mut Vec<Rc<Unit>>) {
        if !seen.insert(Rc::as_ptr(unit)) {
            return;
        }
        for node in &unit.nodes {
            if let Op::Instance(child) = &node.op {
                visit(child, seen, order);
            }
        }
        order.push(Rc::clone(unit));
    }
    let mut order = vec![];
    visit(unit, &mut HashSet::new(), &mut order);
    order
}
