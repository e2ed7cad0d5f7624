//! Pictures of a scheduled block: clocks as columns, formats on the edges, the critical path marked.
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

use crate::graph::{Block, Op};
use std::collections::HashSet;
use std::rc::Rc;

/// A block and all blocks in it, each once, inner ones first.
pub fn blocks(block: &Rc<Block>) -> Vec<Rc<Block>> {
    fn visit(block: &Rc<Block>, seen: &mut HashSet<*const Block>, order: &mut Vec<Rc<Block>>) {
        if !seen.insert(Rc::as_ptr(block)) {
            return;
        }
        for node in &block.nodes {
            if let Op::Instance(child) = &node.op {
                visit(child, seen, order);
            }
        }
        order.push(Rc::clone(block));
    }
    let mut order = vec![];
    visit(block, &mut HashSet::new(), &mut order);
    order
}
