use super::*;

/// Bitwise conjunction of unsigned operands of one width.
#[derive(Clone, Debug, PartialEq)]
pub struct And;

impl Operation for And {
    fn role(&self) -> &'static str {
        "and"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        bitwise(args)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0] & args[1]
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        if args[0] == (1, 1) && args[1] == (1, 1) { (1, 1) } else { (0, args[0].1.min(args[1].1)) }
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = a & b);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], _: Type) -> f64 {
        device.tree(2)
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        words.bitwise(args, Gates::and)
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        args[0].value.clone().binary("and", args[1].value.clone())
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("and", args);
        (Kind::Logic, long, short)
    }

    fn samples() -> Vec<Sample> {
        [Type::FLAG, Type::unsigned(3)].map(|t| Sample::new(Self, &[t, t])).to_vec()
    }
}
