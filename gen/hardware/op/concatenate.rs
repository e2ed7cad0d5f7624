use super::*;

/// Operands side by side, the first in the low bits and with its binary point; only the last may be signed.
#[derive(Clone, Debug, PartialEq)]
pub struct Concatenate;

impl Operation for Concatenate {
    fn role(&self) -> &'static str {
        "word"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let (last, low) = args.split_last().ok_or("expected an operand")?;
        if let Some(signed) = low.iter().find(|a| a.signed) {
            return Err(format!("expected unsigned low bits, found {signed}"));
        }
        Ok(Type { signed: last.signed, bits: args.iter().map(|a| a.bits).sum(), fraction: args[0].fraction })
    }

    fn value(&self, args: &[i128], types: &[Type], _: Type) -> i128 {
        args.iter().zip(types).rev().fold(0, |word, (a, t)| (word << t.bits) | a)
    }

    fn range(&self, args: &[Range], types: &[Type], _: Type) -> Range {
        let word = |bound: fn(&Range) -> i128| {
            args.iter().zip(types).rev().fold(0, |word, (a, t)| (word << t.bits) | bound(a))
        };
        (word(|r| r.0), word(|r| r.1))
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        args.iter().flat_map(|a| a.bits.iter().copied()).collect()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        let kind = if to.signed { "signed" } else { "unsigned" };
        let part = |a: &Operand| {
            let same = a.ty.is_flag() || a.ty.signed == to.signed;
            if same { a.value.clone() } else { Expression::call(kind, [a.value.clone()]) }
        };
        let mut parts = args.iter().rev().map(part);
        let top = parts.next().expect("a word has parts");
        parts.fold(top, |word, part| word.binary("&", part))
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let text = format!("{} side by side", args.len());
        (Kind::Wire, text.clone(), text)
    }

    fn samples() -> Vec<Sample> {
        let u = Type::unsigned;
        vec![Sample::new(Self, &[u(2), Type::signed(3, 0)]), Sample::new(Self, &[Type::FLAG, Type::FLAG]), Sample::new(Self, &[u(2), Type::FLAG, u(1)])]
    }
}
