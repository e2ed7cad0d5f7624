//! The critical path of a block: the chain of nodes within one clock whose value arrives last.

use crate::graph::Op;
use crate::schedule::Schedule;

/// The nodes of the path, last one first; empty where an instance holds a longer path than the block's own nodes.
pub(super) fn path(schedule: &Schedule) -> Vec<usize> {
    let slots = &schedule.slots;
    let last = (0..slots.len()).rev().max_by(|a, b| slots[*a].ns.total_cmp(&slots[*b].ns));
    let Some(mut node) = last else { return vec![] };
    if slots[node].ns < schedule.critical.0 {
        let (inner, name) = schedule.critical.1.split_once('.').unwrap_or_default();
        let holds = |i: &usize| match &schedule.block.nodes[*i].op {
            Op::Instance(_) => schedule.children[i].critical == schedule.critical,
            // The first of the two clocks of a multiplexer is longer than all that ends in a value.
            _ => schedule.block.name == inner && schedule.block.nodes[*i].name() == name,
        };
        return (0..slots.len()).find(holds).into_iter().collect();
    }
    let mut path = vec![node];
    loop {
        let args = &schedule.block.nodes[node].args;
        let before = args.iter().map(|a| a.0).filter(|a| feeds(schedule, *a, node));
        let Some(latest) = before.max_by(|a, b| slots[*a].ns.total_cmp(&slots[*b].ns)) else { return path };
        path.push(latest);
        node = latest;
    }
}

/// Whether a value goes to a node in the clock in which it is computed, and is the latest of the node's operands.
fn feeds(schedule: &Schedule, from: usize, to: usize) -> bool {
    let slots = &schedule.slots;
    let same_clock = |a: usize| slots[a].from == slots[to].start && !slots[to].registered;
    let args = schedule.block.nodes[to].args.iter().map(|a| a.0).filter(|a| same_clock(*a));
    let latest = args.map(|a| slots[a].ns).fold(0.0, f64::max);
    same_clock(from) && slots[from].ns >= latest
}
