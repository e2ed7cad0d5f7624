//! Statements as lines of text.

use crate::expression::{Expression, Index, Name, Sub, loop_variable};
use crate::vhdl::fold::{Shapes, Statement};
use crate::vhdl::package::FUNCTIONS;
use crate::vhdl::shape::Shape;
use std::collections::BTreeSet;

/// Longest line.
const WIDTH: usize = 118;

/// The label of a loop: after the first thing in it.
pub(super) fn loop_label(body: &[Statement]) -> String {
    match &body[0] {
        Statement::Assign(target, _) => {
            let part = |sub: &Sub| match sub {
                Sub::Index(Index::At(i)) | Sub::Range(i, _) => format!("_{i}"),
                Sub::Index(Index::Loop { plus, modulo: None, .. }) if *plus > 0 => format!("_from_{plus}"),
                Sub::Index(Index::Loop { .. }) => String::new(),
                Sub::Field(field) => format!("_{field}"),
            };
            format!("{}{}_each", target.base, target.subs.iter().map(part).collect::<String>())
        }
        Statement::Instance { label, .. } => label.clone(),
        Statement::Loop { body, .. } => format!("{}_of", loop_label(body)),
        Statement::If(..) => "each".to_owned(),
    }
}

pub(super) fn sequential(
    shapes: &dyn Shapes,
    statement: &Statement,
    depth: usize,
    functions: &mut BTreeSet<&'static str>,
    lines: &mut Vec<String>,
) {
    let pad = "  ".repeat(depth);
    match statement {
        Statement::Assign(target, Expression::Select(index, legs))
            if !(index.ty.is_flag() && simple(shapes, target, legs)) =>
        {
            note(&Expression::Select(index.clone(), legs.clone()), functions);
            let flag = index.ty.is_flag() && legs.len() == 2;
            let order: Vec<(usize, &Expression)> =
                if flag { vec![(1, &legs[1]), (0, &legs[0])] } else { legs.iter().enumerate().collect() };
            let last = order.len() - 1;
            for (k, (i, leg)) in order.into_iter().enumerate() {
                let head = match k {
                    0 => format!("if {} then", if flag { condition(&index.value) } else { is(index, i) }),
                    k if k < last => format!("elsif {} then", is(index, i)),
                    _ => "else".to_owned(),
                };
                lines.extend(wrapped(&head, 2 * depth));
                lines.extend(wrapped(&format!("{target} <= {leg};"), 2 * depth + 2));
            }
            lines.push(format!("{pad}end if;"));
        }
        Statement::Assign(target, value) => {
            note(value, functions);
            lines.extend(wrapped(&format!("{target} <= {value};"), 2 * depth));
        }
        Statement::If(flag, then, otherwise) => {
            note(flag, functions);
            lines.extend(wrapped(&format!("if {} then", condition(flag)), 2 * depth));
            then.iter().for_each(|s| sequential(shapes, s, depth + 1, functions, lines));
            match &otherwise[..] {
                [] => {}
                [Statement::If(other, then, rest)] if rest.is_empty() => {
                    lines.extend(wrapped(&format!("elsif {} then", condition(other)), 2 * depth));
                    then.iter().for_each(|s| sequential(shapes, s, depth + 1, functions, lines));
                }
                _ => {
                    lines.push(format!("{pad}else"));
                    otherwise.iter().for_each(|s| sequential(shapes, s, depth + 1, functions, lines));
                }
            }
            lines.push(format!("{pad}end if;"));
        }
        Statement::Loop { depth: variable, first, size, body } => {
            let last = first + size - 1;
            lines.push(format!("{pad}for {} in {first} to {last} loop", loop_variable(*variable)));
            body.iter().for_each(|s| sequential(shapes, s, depth + 1, functions, lines));
            lines.push(format!("{pad}end loop;"));
        }
        Statement::Instance { .. } => panic!("an instance is no sequential statement"),
    }
}

/// Whether a choice between two can be written as a function of numbers.
fn simple(shapes: &dyn Shapes, target: &Name, legs: &[Expression]) -> bool {
    // Whole records and arrays have no such function.
    let number = |name: &Name| matches!(shapes.part(name), Some(Shape::Flag | Shape::Number(..)));
    legs.len() == 2 && !target.subs.is_empty() && number(target)
}

/// `index = i`, as a condition.
pub(super) fn is(index: &crate::op::Operand, i: usize) -> String {
    if let (Some(value), true) = (index.value.number(), index.ty.is_flag()) {
        return (value == i as i128).to_string();
    }
    let value = index.value.clone().known(index.ty);
    if index.ty.is_flag() { format!("{value} = '{i}'") } else { format!("{value} = {i}") }
}

/// A flag as a condition.
pub(super) fn condition(flag: &Expression) -> String {
    match flag {
        // Two literals would leave VHDL without a type to find the comparison by.
        Expression::Number(value, _) => (*value == 1).to_string(),
        Expression::Call("flag", args) => args[0].to_string(),
        Expression::Unary("not", x) if matches!(**x, Expression::Name(_)) => format!("{x} = '0'"),
        Expression::Name(_) | Expression::Bit(..) | Expression::Call(..) => format!("{flag} = '1'"),
        other => format!("({other}) = '1'"),
    }
}

/// Collects the functions of the package that an expression calls.
pub(super) fn note(value: &Expression, functions: &mut BTreeSet<&'static str>) {
    match value {
        Expression::Call(name @ ("to_signed" | "to_unsigned"), args) if !matches!(args[0], Expression::Integer(_)) => {
            functions.insert(name);
        }
        Expression::Call(name, _) if FUNCTIONS.contains(name) => {
            functions.insert(name);
        }
        Expression::Select(index, legs) if legs.len() == 2 && index.ty.is_flag() => {
            functions.insert("choose");
        }
        Expression::Select(index, _) | Expression::Table { index, .. } if !index.ty.is_flag() => {
            functions.insert("known");
        }
        _ => {}
    }
    value.parts().into_iter().for_each(|p| note(p, functions));
}

/// A line, broken where it is too long at the space that is in the fewest parentheses; what follows is indented more.
pub(super) fn wrapped(text: &str, indent: usize) -> Vec<String> {
    let mut lines = vec![];
    let mut pad = indent;
    let mut rest = text;
    while pad + rest.len() > WIDTH {
        let room = WIDTH - pad;
        let (mut depth, mut quoted, mut best) = (0, false, None);
        for (at, c) in rest[..room].char_indices() {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                '"' => quoted = !quoted,
                // In a port map between associations alone.
                ' ' if !quoted
                    && (!text.starts_with("port map") || rest[..at].ends_with(','))
                    && at > room / 3
                    && best.is_none_or(|(least, _)| depth <= least) =>
                {
                    best = Some((depth, at));
                }
                _ => {}
            }
        }
        let Some((_, at)) = best else { break };
        lines.push(format!("{}{}", " ".repeat(pad), &rest[..at]));
        rest = &rest[at + 1..];
        pad = indent + if text.starts_with("port map") { 10 } else { 4 };
    }
    lines.push(format!("{}{rest}", " ".repeat(pad)));
    lines
}
