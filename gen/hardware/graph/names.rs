//! Names from structure: what nobody named is called after what reads it, or after what it is made of.

use super::place::{Place, Step};
use super::unit::{Node, Op, Unit};
use crate::op::Comb;
use std::collections::HashMap;

/// Names every node of a unit that has no name.
///
/// # Panics
/// If two nodes would have one name: then one of them needs a name of its own.
pub(super) fn derive(unit: &mut Unit) {
    let mut readers: Vec<Vec<usize>> = vec![vec![]; unit.nodes.len()];
    for (i, node) in unit.nodes.iter().enumerate() {
        for arg in &node.args {
            if !readers[arg.0].contains(&i) {
                readers[arg.0].push(i);
            }
        }
    }
    for (_, output) in &unit.outputs {
        let node = &unit.nodes[output.0];
        assert!(node.named, "unit {}: an output has no name ({:?})", unit.name, node.op);
        // An output is read outside as well.
        readers[output.0].push(usize::MAX);
    }
    let places: Vec<Place> = (0..unit.nodes.len()).map(|i| place(unit, &readers, i)).collect();
    let mut known: HashMap<String, usize> = HashMap::new();
    for (i, place) in places.into_iter().enumerate() {
        let node = &mut unit.nodes[i];
        node.place = place;
        // Neither constants nor what is no hardware is declared.
        if matches!(node.op, Op::Comb(Comb::Constant(_)) | Op::Assume(..) | Op::Known(_) | Op::Point) {
            continue;
        }
        if let Some(other) = known.insert(node.name(), i) {
            let (name, op) = (node.name(), node.op.clone());
            panic!("unit {}: two nodes are called {name}: {:?} and {op:?}", unit.name, unit.nodes[other].op);
        }
    }
    for output in 0..unit.outputs.len() {
        let (_, id) = unit.outputs[output];
        unit.outputs[output].0 = unit.node(id).place.clone();
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
        Op::Input { .. } | Op::Steady => "port",
        Op::Output(_) => "result",
    };
    role.to_owned()
}

fn place(unit: &Unit, readers: &[Vec<usize>], i: usize) -> Place {
    let node = &unit.nodes[i];
    if node.named {
        return node.place.clone();
    }
    // An instance is called after its first output, less the way to it in the unit's own bundle.
    if let Op::Instance(child) = &node.op {
        let first = readers[i].first().expect("an instance has outputs");
        let mut place = place(unit, readers, *first);
        let own = child.outputs[0].0.path.len();
        place.path.truncate(place.path.len().saturating_sub(own));
        return place.suffixed("unit");
    }
    if let Op::Output(port) = &node.op
        && (readers[i].len() != 1 || matches!(unit.nodes[readers[i][0]].op, Op::Instance(_)))
    {
        return made_of(unit, i, port);
    }
    // What reads a constant of each phase is shared over the elements of a bundle.
    if let (Op::Phase(_), Some(reader)) = (&node.op, readers[i].first()) {
        let mut above = place(unit, readers, *reader).suffixed(&role(node));
        let elements = above.path.iter().take_while(|step| matches!(step, Step::Index(_))).count();
        above.path.truncate(elements);
        return above;
    }
    match readers[i][..] {
        [reader] if reader != usize::MAX => {
            let reading = &unit.nodes[reader];
            let at: Vec<usize> = (0..reading.args.len()).filter(|k| reading.args[*k].0 == i).collect();
            let mut above = place(unit, readers, reader);
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
                let arg = &unit.nodes[reading.args[*k].0];
                !arg.named && role(arg) == role(node)
            };
            let twins = (0..reading.args.len()).filter(same).count() > at.len();
            let above = above.suffixed(&role(node));
            if twins { above.suffixed(ORDINALS.get(at[0]).copied().unwrap_or("last")) } else { above }
        }
        _ => {
            // A multiplexer is made of its operands, not of what chooses among them.
            let first = usize::from(matches!(node.op, Op::Mux { .. }));
            let below = node.args.get(first).map_or_else(|| Place::new(unit.name.clone()), |a| source(unit, a.0));
            below.suffixed(&role(node))
        }
    }
}

const ORDINALS: [&str; 8] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"];

/// An output that several read, or that goes straight into another instance: after its unit's operand and port.
fn made_of(unit: &Unit, i: usize, port: &usize) -> Place {
    let instance = &unit.nodes[unit.nodes[i].args[0].0];
    let Op::Instance(child) = &instance.op else { unreachable!("outputs are of instances") };
    let named = instance.args.iter().map(|a| &unit.nodes[a.0]).find(|n| n.named);
    let of = named.map_or_else(|| unit.name.clone(), Node::name);
    Place::new(format!("{of}_{}", child.outputs[*port].0))
}

/// The first named node that a node is made of, with what was done to it.
fn source(unit: &Unit, i: usize) -> Place {
    let node = &unit.nodes[i];
    if node.named {
        return node.place.clone();
    }
    match node.args.first() {
        Some(first) => source(unit, first.0).suffixed(&role(node)),
        None => Place::new(role(node)),
    }
}
