use super::*;

/// Absolute value of a signed operand, unsigned, in as many bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Magnitude;

impl Operation for Magnitude {
    fn role(&self) -> &'static str {
        "magnitude"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        if !args[0].signed {
            return Err(format!("expected a signed number, found {}", args[0]));
        }
        Ok(Type { signed: false, ..args[0] })
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0].abs()
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        match args[0] {
            (lo, _) if lo >= 0 => args[0],
            (lo, hi) if hi <= 0 => (-hi, -lo),
            (lo, hi) => (0, hi.max(-lo)),
        }
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = a.abs());
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.conditional_negation(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        let value = &args[0].bits;
        words.negate_if(value[value.len() - 1], value)
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        Expression::call("abs_of", [args[0].value.clone()])
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Sum, format!("|{}|", args[0]), "|a|".to_owned())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self, &[Type::signed(5, 0)])]
    }
}
