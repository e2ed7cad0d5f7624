use super::*;

/// Flag: a signed operand is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct SignBit;

impl Operation for SignBit {
    fn role(&self) -> &'static str {
        "negative"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        if !args[0].signed {
            return Err(format!("expected a signed number, found {}", args[0]));
        }
        Ok(Type::FLAG)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        i128::from(args[0] < 0)
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (i128::from(args[0].1 < 0), i128::from(args[0].0 < 0))
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = i64::from(*a < 0));
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        vec![args[0].bits[args[0].bits.len() - 1]]
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        args[0].value.clone().bit(args[0].ty.bits - 1)
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Wire, format!("{} < 0", args[0]), "a < 0".to_owned())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self, &[Type::signed(4, 0)])]
    }
}
