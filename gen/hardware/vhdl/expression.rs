//! Expressions: what an operation looks like in VHDL.

use crate::graph::netlist::{Driver, Module, Signal, SignalId};
use crate::graph::{Op, Type};

/// A value, or a choice of values under conditions with a last resort.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expression {
    /// One expression.
    Simple(String),
    /// `value when condition`, in order, and the value of all remaining cases.
    Choice(Vec<(String, String)>, String),
}

/// Whether a type is a single `std_logic`.
pub fn is_flag(t: Type) -> bool {
    t.bits == 1 && !t.signed
}

/// The VHDL type of a signal inside an architecture.
pub fn type_name(t: Type) -> String {
    if is_flag(t) {
        return "std_logic".to_owned();
    }
    let kind = if t.signed { "signed" } else { "unsigned" };
    format!("{kind}({} downto 0)", t.bits - 1)
}

/// The VHDL type of a port.
pub fn port_type(t: Type) -> String {
    if is_flag(t) { "std_logic".to_owned() } else { format!("std_logic_vector({} downto 0)", t.bits - 1) }
}

/// Whether a signal is declared as a vector of no number kind: ports and outputs of instances.
pub fn raw(signal: &Signal) -> bool {
    matches!(signal.driver, Driver::Port | Driver::Instance { .. })
}

/// A literal of the given type.
pub fn literal(value: i128, t: Type) -> String {
    let bits: String = (0..t.bits).rev().map(|i| if (value >> i) & 1 == 1 { '1' } else { '0' }).collect();
    if is_flag(t) { format!("'{bits}'") } else { format!("\"{bits}\"") }
}

/// Prints the operations of one module.
pub struct Printer<'a>(pub &'a Module);

impl Printer<'_> {
    fn signal(&self, id: SignalId) -> &Signal {
        self.0.signal(id)
    }

    /// A signal as a value of its own type.
    pub fn value(&self, id: SignalId) -> String {
        let s = self.signal(id);
        self.cast(&s.name, id)
    }

    /// Part of a signal, by name and slice, in the signal's own number kind.
    fn cast(&self, text: &str, id: SignalId) -> String {
        let s = self.signal(id);
        match (raw(s) && !is_flag(s.ty), s.ty.signed) {
            (false, _) => text.to_owned(),
            (true, true) => format!("signed({text})"),
            (true, false) => format!("unsigned({text})"),
        }
    }

    /// A signal as a port's value.
    pub fn port_value(&self, id: SignalId) -> String {
        let s = self.signal(id);
        if raw(s) || is_flag(s.ty) { s.name.clone() } else { format!("std_logic_vector({})", s.name) }
    }

    /// A signal widened (or cut, where the value is known to fit) to a number type.
    fn resized(&self, id: SignalId, to: Type) -> String {
        let s = self.signal(id);
        let t = s.ty;
        if is_flag(t) {
            return match (to.signed, to.bits) {
                (false, 1) => s.name.clone(),
                (true, 2) => format!("signed'('0' & {})", s.name),
                (false, 2) => format!("unsigned'('0' & {})", s.name),
                (true, bits) => format!("resize(signed'('0' & {}), {bits})", s.name),
                (false, bits) => format!("resize(unsigned'('0' & {}), {bits})", s.name),
            };
        }
        let same_kind = t.signed == to.signed;
        let text = if t.bits > to.bits {
            if is_flag(to) {
                return format!("{}(0)", s.name);
            }
            self.cast(&format!("{}({} downto 0)", s.name, to.bits - 1), id)
        } else if t.bits == to.bits {
            self.value(id)
        } else {
            format!("resize({}, {})", self.value(id), to.bits)
        };
        match (same_kind, to.signed) {
            (true, _) => text,
            (false, true) => format!("signed({text})"),
            (false, false) => format!("unsigned({text})"),
        }
    }

    fn is(&self, id: SignalId, value: usize) -> String {
        let s = self.signal(id);
        if is_flag(s.ty) { format!("{} = '{value}'", s.name) } else { format!("{} = {value}", self.value(id)) }
    }

    /// The expression of an operation with a result of type `to`. `clamp` names the bounds of an [`Op::Clamp`].
    pub fn expression(&self, op: &Op, args: &[SignalId], to: Type, clamp: &[String; 2]) -> Expression {
        let simple = |text: String| Expression::Simple(text);
        let flag = |condition: String| Expression::Choice(vec![("'1'".to_owned(), condition)], "'0'".to_owned());
        let both = |operator: &str| format!("{} {operator} {}", self.resized(args[0], to), self.resized(args[1], to));
        let joint = || {
            let bits = args.iter().map(|a| self.signal(*a).ty.bits).max().unwrap_or(1);
            Type { bits, ..self.signal(args[0]).ty }
        };
        match op {
            Op::Constant(value) => simple(literal(*value, to)),
            Op::Add => simple(both("+")),
            Op::Subtract => simple(both("-")),
            Op::Negate => simple(format!("-{}", self.resized(args[0], to))),
            Op::NegateIf => {
                // Complement and carry: one look-up table a bit, together with a choice in front of it.
                let (flag, top) = (&self.signal(args[0]).name, to.bits - 1);
                let one = self.resized(args[0], to);
                simple(format!("({} xor ({top} downto 0 => {flag})) + {one}", self.value(args[1])))
            }
            Op::Multiply => simple(format!("{} * {}", self.value(args[0]), self.value(args[1]))),
            Op::Equal => {
                let t = joint();
                flag(format!("{} = {}", self.resized(args[0], t), self.resized(args[1], t)))
            }
            Op::And => simple(format!("{} and {}", self.value(args[0]), self.value(args[1]))),
            Op::Or => simple(format!("{} or {}", self.value(args[0]), self.value(args[1]))),
            Op::Not => simple(format!("not {}", self.value(args[0]))),
            Op::AnyBit if is_flag(self.signal(args[0]).ty) => simple(self.value(args[0])),
            Op::AnyBit => {
                Expression::Choice(vec![("'0'".to_owned(), format!("{} = 0", self.value(args[0])))], "'1'".to_owned())
            }
            Op::SignBit => {
                let s = self.signal(args[0]);
                simple(format!("{}({})", s.name, s.ty.bits - 1))
            }
            Op::Magnitude => {
                let s = self.signal(args[0]);
                let (top, sign) = (s.ty.bits - 1, format!("{}({})", s.name, s.ty.bits - 1));
                let (value, bits) = (self.value(args[0]), s.ty.bits);
                let one = format!("resize(signed'('0' & {sign}), {bits})");
                simple(format!("unsigned(({value} xor ({top} downto 0 => {sign})) + {one})"))
            }
            Op::Floor(drop) => {
                let s = self.signal(args[0]);
                simple(if is_flag(to) {
                    format!("{}({})", s.name, s.ty.bits - 1)
                } else {
                    self.cast(&format!("{}({} downto {drop})", s.name, s.ty.bits - 1), args[0])
                })
            }
            Op::Append(zeros) => simple(format!("{} & \"{}\"", self.value(args[0]), "0".repeat(*zeros as usize))),
            Op::LowBits(bits) => {
                let s = self.signal(args[0]);
                let slice = format!("{}({} downto 0)", s.name, bits - 1);
                simple(match (is_flag(to), raw(s) || s.ty.signed) {
                    (true, _) => format!("{}(0)", s.name),
                    (false, true) => format!("unsigned({slice})"),
                    (false, false) => slice,
                })
            }
            Op::Clamp(..) => {
                let a = self.value(args[0]);
                let [low, high] = clamp.clone();
                let cases = vec![(high.clone(), format!("{a} > {high}")), (low.clone(), format!("{a} < {low}"))];
                Expression::Choice(cases, a)
            }
            Op::Resize(_) | Op::Reinterpret(_) => simple(self.resized(args[0], to)),
            Op::Lookup(table, _) => self.lookup(table, args[0], to),
            Op::Select => {
                let legs = &args[1..];
                let last = legs.len() - 1;
                let value = |i: usize| self.resized(legs[i], to);
                if is_flag(self.signal(args[0]).ty) && legs.len() == 2 {
                    return Expression::Choice(vec![(value(1), self.is(args[0], 1))], value(0));
                }
                Expression::Choice((0..last).map(|i| (value(i), self.is(args[0], i))).collect(), value(last))
            }
            Op::Concatenate => {
                let kind = if to.signed { "signed" } else { "unsigned" };
                let part = |id: &SignalId| {
                    let t = self.signal(*id).ty;
                    let value = self.value(*id);
                    if t.signed == to.signed || is_flag(t) { value } else { format!("{kind}({value})") }
                };
                simple(args.iter().rev().map(part).collect::<Vec<_>>().join(" & "))
            }
            Op::Input
            | Op::Assert(..)
            | Op::Fact(_)
            | Op::Phase(..)
            | Op::Hold { .. }
            | Op::Choose { .. }
            | Op::ScanOr
            | Op::Instance(_)
            | Op::Output(_) => unreachable!("{op:?} is no operation of a module"),
        }
    }

    /// A table by value: the most frequent one is the last resort.
    fn lookup(&self, table: &[i128], index: SignalId, to: Type) -> Expression {
        let mut values: Vec<i128> = vec![];
        for value in table {
            if !values.contains(value) {
                values.push(*value);
            }
        }
        let count = |v: i128| table.iter().filter(|x| **x == v).count();
        let rest = values.iter().copied().max_by_key(|v| (count(*v), -v)).expect("a table has entries");
        let cases = values.into_iter().filter(|v| *v != rest).map(|v| {
            let places = (0..table.len()).filter(|i| table[*i] == v);
            let conditions: Vec<String> = places.map(|i| self.is(index, i)).collect();
            (literal(v, to), conditions.join(" or "))
        });
        Expression::Choice(cases.collect(), literal(rest, to))
    }
}
