use super::*;

/// Flag: some bit of an unsigned operand is set.
#[derive(Clone, Debug, PartialEq)]
pub struct OrReduce;

impl Operation for OrReduce {
    fn role(&self) -> &'static str {
        "any"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        bitwise(args).map(|_| Type::FLAG)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        i128::from(args[0] != 0)
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (i128::from(args[0].0 > 0), i128::from(args[0].1 > 0))
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = i64::from(*a != 0));
        true
    }

    fn delay(&self, device: &Device, args: &[Type], _: Type) -> f64 {
        device.tree(args[0].bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        vec![words.gates.any(&args[0].bits)]
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        let value = args[0].value.clone();
        if args[0].ty.is_flag() { value } else { Expression::call("or_reduce", [value]) }
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Logic, format!("or of {}", args[0]), "or of the bits".to_owned())
    }

    fn samples() -> Vec<Sample> {
        [Type::FLAG, Type::unsigned(5)].map(|t| Sample::new(Self, &[t])).to_vec()
    }
}
