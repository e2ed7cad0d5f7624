//! Static range analysis: the proof that every value fits its type, in every phase.
//!
//! Ranges are exact integer intervals propagated through the dissolved graph phase by phase, from the declared ranges
//! of the inputs. Relations that intervals cannot see enter as [`Op::Assert`] and [`Op::Clamp`], each with a lemma.

use super::flat::Flat;
use super::{Op, Range, Type, Unit};
use std::rc::Rc;

/// A value that may not fit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}, phase {phase}: values from {} to {} do not fit {ty}", range.0, range.1)]
pub struct Overflow {
    /// Where.
    pub path: String,
    /// In which phase.
    pub phase: usize,
    /// The values.
    pub range: Range,
    /// The type they do not fit.
    pub ty: Type,
}

/// The ranges of all nodes of the different units of a graph, each the union over instances and phases.
#[derive(Clone, Debug)]
pub struct Ranges {
    /// The units, the top first.
    pub units: Vec<Rc<Unit>>,
    /// One range a node of each unit; `None` where a unit has no instance that computes it.
    pub of: Vec<Vec<Option<Range>>>,
}

impl Ranges {
    /// The ranges of a unit's nodes.
    pub fn unit(&self, unit: &Rc<Unit>) -> Option<&[Option<Range>]> {
        self.units.iter().position(|u| Rc::ptr_eq(u, unit)).map(|i| self.of[i].as_slice())
    }
}

fn union(slot: &mut Option<Range>, r: Range) {
    *slot = Some(slot.map_or(r, |s| (s.0.min(r.0), s.1.max(r.1))));
}

/// Analyses a graph from the declared ranges of its inputs.
///
/// # Errors
/// The first value, in data-flow order, that may not fit its type or the declared range of a port.
pub fn analyse(top: &Rc<Unit>) -> Result<Ranges, Overflow> {
    let flat = Flat::new(top);
    analyse_flat(&flat).map(|(ranges, _)| ranges)
}

/// As [`analyse`], and the range of each (node, phase), indexed `node * interval + phase`.
///
/// # Errors
/// As [`analyse`].
pub fn analyse_flat(flat: &Flat) -> Result<(Ranges, Vec<Range>), Overflow> {
    let interval = flat.interval;
    let mut ranges: Vec<Range> = vec![(0, 0); flat.nodes.len() * interval];
    let mut of: Vec<Vec<Option<Range>>> = flat.units.iter().map(|u| vec![None; u.nodes.len()]).collect();
    let mut args = vec![];
    let mut types = vec![];
    for step in &flat.steps {
        let node = &flat.nodes[step.node];
        let at = |n: usize, phase: usize| ranges[n * interval + if flat.per_phase(n) { phase } else { 0 }];
        let range = match &node.op {
            Op::Input => {
                let unit = &flat.units[node.origin.0];
                let input = unit.inputs.iter().find(|i| i.node.0 == node.origin.1).expect("inputs have ports");
                input.range
            }
            Op::Phase(values, _) => {
                let value = values[step.phase].unwrap_or(0);
                (value, value)
            }
            Op::Hold { .. } | Op::Choose { .. } => {
                let operand = flat.operands(*step)[0];
                ranges[operand.node * interval + operand.phase]
            }
            Op::ScanOr => {
                let fresh = at(node.args[0], step.phase);
                if step.phase == 0 || at(node.args[1], step.phase) == (1, 1) {
                    fresh
                } else {
                    Op::Or.range(&[fresh, ranges[step.node * interval + step.phase - 1]], &[], node.ty)
                }
            }
            op => {
                args.clear();
                types.clear();
                for a in &node.args {
                    args.push(at(*a, step.phase));
                    types.push(flat.nodes[*a].ty);
                }
                op.range(&args, &types, node.ty)
            }
        };
        let (min, max) = node.ty.limits();
        if range.0 < min || range.1 > max {
            return Err(Overflow { path: node.path.clone(), phase: step.phase, range, ty: node.ty });
        }
        ranges[step.node * interval + step.phase] = range;
        union(&mut of[node.origin.0][node.origin.1], range);
    }
    for binding in &flat.bindings {
        let unit = &flat.units[binding.unit];
        let input = &unit.inputs[binding.input];
        let phases = if flat.per_phase(binding.arg) { interval } else { 1 };
        for phase in 0..phases {
            let range = ranges[binding.arg * interval + phase];
            if range.0 < input.range.0 || range.1 > input.range.1 {
                let port = unit.node(input.node);
                let path = format!("{}, port {} (declared {:?})", binding.path, port.name, input.range);
                return Err(Overflow { path, phase, range, ty: port.ty });
            }
            union(&mut of[binding.unit][input.node.0], range);
        }
    }
    Ok((Ranges { units: flat.units.clone(), of }, ranges))
}
