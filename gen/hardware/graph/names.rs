//! Names from structure: what nobody named is called after what reads it, or after what it is made of.

use super::block::{Block, Node, Op};
use super::place::{Place, Step};
use crate::op::Comb;
use std::collections::HashMap;

/// Names every node of a block that has no name.
///
/// # Panics
/// If two nodes would have one name: then one of them needs a name of its own.
pub(super) fn derive(block: &mut Block) {
    let mut readers: Vec<Vec<usize>> = vec![vec![]; block.nodes.len()];
    for (i, node) in block.nodes.iter().enumerate() {
        for arg in &node.args {
            if !readers[arg.0].contains(&i) {
                readers[arg.0].push(i);
            }
        }
    }
    for (_, output) in &block.outputs {
        let node = &block.nodes[output.0];
        assert!(node.named, "block {}: an output has no name ({:?})", block.name, node.op);
        // An output is read outside as well.
        readers[output.0].push(usize::MAX);
    }
    let places: Vec<Place> = (0..block.nodes.len()).map(|i| place(block, &readers, i)).collect();
    let mut known: HashMap<String, usize> = HashMap::new();
    for (i, place) in places.into_iter().enumerate() {
        let node = &mut block.nodes[i];
        node.place = place;
        // Neither constants nor what is no hardware is declared.
        if matches!(node.op, Op::Comb(Comb::Constant(_)) | Op::Assume(..) | Op::Known(_) | Op::Point) {
            continue;
        }
        if let Some(other) = known.insert(node.name(), i) {
            let (name, op) = (node.name(), node.op.clone());
            panic!("block {}: two nodes are called {name}: {:?} and {op:?}", block.name, block.nodes[other].op);
        }
    }
    for output in 0..block.outputs.len() {
        let (_, id) = block.outputs[output];
        block.outputs[output].0 = block.node(id).place.clone();
    }
}

/// What kind of value a node is: what it was called, or what its operation makes; nothing of a step that only says what
/// is known.
fn role(node: &Node) -> String {
    if !node.place.is_empty() {
        return node.place.base.clone();
    }
    let role = match &node.op {
        Op::Comb(Comb::Floor(op)) => return format!("floor_{}", op.0),
        Op::Comb(op) => op.role(),
        Op::Phase(_) => "select",
        Op::Capture { .. } => "captured",
        Op::Mux { .. } => "operand",
        Op::ScanOr => "so_far",
        Op::Earlier(_) => "before",
        Op::Assume(..) | Op::Known(_) | Op::Point => "",
        Op::Instance(_) => "unit",
        Op::Input | Op::Steady => "port",
        Op::Output(_) => "result",
    };
    role.to_owned()
}

fn place(block: &Block, readers: &[Vec<usize>], i: usize) -> Place {
    let node = &block.nodes[i];
    if node.named {
        return node.place.clone();
    }
    // An instance is called after its first output, less the way to it in the block's own bundle.
    if let Op::Instance(child) = &node.op {
        let first = readers[i].first().expect("an instance has outputs");
        let mut place = place(block, readers, *first);
        let own = child.outputs[0].0.path.len();
        place.path.truncate(place.path.len().saturating_sub(own));
        return place.suffixed("unit");
    }
    if let Op::Output(port) = &node.op
        && (readers[i].len() != 1 || matches!(block.nodes[readers[i][0]].op, Op::Instance(_)))
    {
        return made_of(block, i, port);
    }
    // What reads a constant of each phase is shared over the elements of a bundle.
    if let (Op::Phase(_), Some(reader)) = (&node.op, readers[i].first()) {
        let mut above = place(block, readers, *reader).suffixed(&role(node));
        let elements = above.path.iter().take_while(|step| matches!(step, Step::Index(_))).count();
        above.path.truncate(elements);
        return above;
    }
    match readers[i][..] {
        [reader] if reader != usize::MAX => {
            let reading = &block.nodes[reader];
            let at: Vec<usize> = (0..reading.args.len()).filter(|k| reading.args[*k].0 == i).collect();
            let mut above = place(block, readers, reader);
            // What is only resized needs no word for it; which of several operands it is stays.
            if let (Op::Comb(Comb::Resize(_)), false, Some(at)) =
                (&reading.op, reading.named, above.suffix.rfind("_resized"))
            {
                above.suffix.replace_range(at..at + "_resized".len(), "");
            }
            if let Op::Instance(child) = &reading.op {
                let port = &child.node(child.inputs[at[0]]).place;
                let base = format!("{}{}_{}", above.base, above.suffix.trim_end_matches("_unit"), port.base);
                let path = [&above.path[..], &port.path[..]].concat();
                return Place { suffix: port.suffix.clone(), ..Place::at(base, &path) };
            }
            // Operands of one kind are told apart by where they stand.
            let same = |k: &usize| {
                let arg = &block.nodes[reading.args[*k].0];
                !arg.named && role(arg) == role(node)
            };
            let twins = (0..reading.args.len()).filter(same).count() > at.len();
            let above = above.suffixed(&role(node));
            if twins { above.suffixed(&ordinal(at[0])) } else { above }
        }
        _ => {
            // A multiplexer is made of its operands, not of what chooses among them.
            let first = usize::from(matches!(node.op, Op::Mux { .. }));
            let below = node.args.get(first).map_or_else(|| Place::new(block.name.clone()), |a| source(block, a.0));
            below.suffixed(&role(node))
        }
    }
}

/// The place of an operand, counted from 0: in words up to eighth, then 9th and so on.
fn ordinal(place: usize) -> String {
    ORDINALS.get(place).map_or_else(|| format!("{}th", place + 1), |word| (*word).to_owned())
}

const ORDINALS: [&str; 8] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"];

/// An output that several read, or that goes straight into another instance: after its block's operand and port.
fn made_of(block: &Block, i: usize, port: &usize) -> Place {
    let instance = &block.nodes[block.nodes[i].args[0].0];
    let Op::Instance(child) = &instance.op else { unreachable!("outputs are of instances") };
    let named = instance.args.iter().map(|a| &block.nodes[a.0]).find(|n| n.named);
    let of = named.map_or_else(|| block.name.clone(), Node::name);
    Place::new(format!("{of}_{}", child.outputs[*port].0))
}

/// The first named node that a node is made of, with what was done to it.
fn source(block: &Block, i: usize) -> Place {
    let node = &block.nodes[i];
    if node.named {
        return node.place.clone();
    }
    match node.args.first() {
        Some(first) => source(block, first.0).suffixed(&role(node)),
        None => Place::new(role(node)),
    }
}
