//! What a node computes, in a few characters.

use crate::graph::{Block, Op};
use crate::op::{self, Comb};

/// What a box stands for; it sets the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An input or output of the block.
    Port,
    /// A combinational operation.
    Operation(op::Kind),
    /// What time sharing takes: multiplexers by phase, captures.
    Sharing,
    /// An instance of another block.
    Instance,
}

/// Operands are written out where the whole is no longer than this many characters.
const LONGEST: usize = 30;

/// The kind of node `i`, and its operation with the names of its operands, or without them where that is too long.
pub(super) fn operation(block: &Block, i: usize) -> (Kind, String) {
    let node = &block.nodes[i];
    let (kind, text) = match &node.op {
        Op::Comb(op) => {
            let operands: Vec<String> = node.args.iter().map(|a| operand(block, a.0)).collect();
            let (kind, long, short) = op.picture(&operands);
            return (Kind::Operation(kind), if long.chars().count() <= LONGEST { long } else { short });
        }
        Op::Input | Op::Steady => (Kind::Port, "input".to_owned()),
        Op::Mux { late } if late.len() == 1 => (Kind::Sharing, "in every phase".to_owned()),
        Op::Mux { late } => (Kind::Sharing, format!("one of {} by phase", late.len())),
        Op::Capture { phase, .. } => (Kind::Sharing, format!("captured in phase {phase}")),
        Op::Earlier(n) => (Kind::Sharing, format!("{n} phases before")),
        Op::ScanOr => (Kind::Sharing, "or over the phases".to_owned()),
        Op::Instance(child) => (Kind::Instance, child.name.clone()),
        // These have no box.
        Op::Phase(_) | Op::Assume(..) | Op::Known(_) | Op::Point | Op::Output(_) => (Kind::Port, String::new()),
    };
    (kind, text)
}

/// The name of an operand: of what it is a name for, and the value of a constant.
fn operand(block: &Block, mut i: usize) -> String {
    while block.renames(i) || matches!(block.nodes[i].op, Op::Comb(Comb::Resize(_))) {
        i = block.nodes[i].args[0].0;
    }
    match &block.nodes[i].op {
        Op::Comb(Comb::Constant(constant)) => constant.0.to_string(),
        _ => block.nodes[i].name(),
    }
}
