use super::*;

/// Bitwise complement of an unsigned operand.
#[derive(Clone, Debug, PartialEq)]
pub struct Not;

impl Operation for Not {
    fn role(&self) -> &'static str {
        "not"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        bitwise(args)
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        to.limits().1 - args[0]
    }

    fn range(&self, args: &[Range], _: &[Type], to: Type) -> Range {
        (to.limits().1 - args[0].1, to.limits().1 - args[0].0)
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        let ones = to.limits().1 as i64;
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = ones - a);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], _: Type) -> f64 {
        device.tree(2)
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        args[0].bits.iter().map(|b| !*b).collect()
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        Expression::unary("not", args[0].value.clone())
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Logic, format!("not {}", args[0]), "not".to_owned())
    }

    fn samples() -> Vec<Sample> {
        [Type::FLAG, Type::unsigned(3)].map(|t| Sample::new(Self, &[t])).to_vec()
    }
}
