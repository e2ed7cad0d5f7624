//! What a node computes, in a few characters.

use crate::graph::{Op, Unit};

/// Operands are written out where the whole is no longer than this many characters.
const LONGEST: usize = 30;

/// The operation of node `i` with the names of its operands, or without them where that is too long.
pub(super) fn operation(unit: &Unit, i: usize) -> String {
    let node = &unit.nodes[i];
    let arg = |k: usize| node.args.get(k).map_or(String::new(), |a| operand(unit, a.0));
    let both = |sign: &str| (format!("{} {sign} {}", arg(0), arg(1)), format!("a {sign} b"));
    let one = |name: &str| (format!("{name}({})", arg(0)), name.to_owned());
    let plain = |text: String| (text.clone(), text);
    let (long, short) = match &node.op {
        Op::Input => plain("input".to_owned()),
        Op::Add => both("+"),
        Op::Subtract => both("\u{2212}"),
        Op::Negate => (format!("\u{2212}{}", arg(0)), "\u{2212}a".to_owned()),
        Op::NegateIf => (format!("{} ? \u{2212}{1} : {1}", arg(0), arg(1)), "c ? \u{2212}a : a".to_owned()),
        Op::Multiply => both("\u{d7}"),
        Op::Equal => both("="),
        Op::And => both("and"),
        Op::Or => both("or"),
        Op::Not => (format!("not {}", arg(0)), "not".to_owned()),
        Op::AnyBit => one("any bit"),
        Op::SignBit => (format!("{} < 0", arg(0)), "a < 0".to_owned()),
        Op::Magnitude => (format!("|{}|", arg(0)), "|a|".to_owned()),
        Op::Floor(bits) => plain(format!("floor, {bits} bits cut")),
        Op::Append(bits) => plain(format!("{bits} zeros appended")),
        Op::LowBits(bits) => plain(format!("low {bits} bits")),
        Op::Clamp(bound, _) => plain(format!("within \u{b1}{bound}")),
        Op::Lookup(..) => one("table"),
        Op::Select if node.args.len() == 3 => (format!("{} ? {} : {}", arg(0), arg(2), arg(1)), "c ? a : b".to_owned()),
        Op::Select => {
            (format!("one of {} by {}", node.args.len() - 1, arg(0)), format!("one of {}", node.args.len() - 1))
        }
        Op::Concatenate => plain(format!("{} side by side", node.args.len())),
        Op::Hold { phase, .. } => plain(format!("held from phase {phase}")),
        Op::Choose { lagged } if lagged.len() == 1 => plain("in every phase".to_owned()),
        Op::Choose { lagged } => plain(format!("one of {} by phase", lagged.len())),
        Op::ScanOr => plain("or over the phases".to_owned()),
        Op::Instance(child) => plain(child.name.clone()),
        Op::Constant(_)
        | Op::Resize(_)
        | Op::Reinterpret(_)
        | Op::Assert(..)
        | Op::Fact(_)
        | Op::Phase(..)
        | Op::Output(_) => plain(String::new()),
    };
    if long.chars().count() <= LONGEST { long } else { short }
}

/// The name of an operand: of what it is a name for, and the value of a constant.
fn operand(unit: &Unit, mut i: usize) -> String {
    while unit.renames(i) || matches!(unit.nodes[i].op, Op::Resize(_)) {
        i = unit.nodes[i].args[0].0;
    }
    match &unit.nodes[i].op {
        Op::Constant(value) => value.to_string(),
        _ => unit.nodes[i].name.clone(),
    }
}
