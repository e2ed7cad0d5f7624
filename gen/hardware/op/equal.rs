use super::*;

/// Flag: both operands are equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Equal;

impl Operation for Equal {
    fn role(&self) -> &'static str {
        "equal"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        Type::joint(args).map(|_| Type::FLAG)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        i128::from(args[0] == args[1])
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let [a, b] = [args[0], args[1]];
        if a.1 < b.0 || b.1 < a.0 { (0, 0) } else { (0, 1) }
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = i64::from(a == b));
        true
    }

    fn delay(&self, device: &Device, args: &[Type], _: Type) -> f64 {
        device.equality(args.iter().map(|t| t.bits).max().unwrap_or(0))
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        let bits = args[0].bits.len().max(args[1].bits.len()) as u32;
        vec![words.gates.equal(&args[0].resized(bits), &args[1].resized(bits))]
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        let bits = args[0].ty.bits.max(args[1].ty.bits);
        let joint = Type { bits, ..args[0].ty };
        let [a, b] = [args[0].resized(joint), args[1].resized(joint)];
        Expression::call("flag", [a.known(joint).binary("=", b.known(joint))])
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("=", args);
        (Kind::Comparison, long, short)
    }

    fn samples() -> Vec<Sample> {
        let u = Type::unsigned;
        [[Type::signed(4, 0); 2], [u(3), u(4)], [Type::FLAG; 2]].map(|types| Sample::new(Self, &types)).to_vec()
    }
}
