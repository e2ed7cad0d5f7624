use super::*;

/// Flag: a signed operand is less than another: the sign of their difference. One carry chain on every device, which
/// synthesisers do not all make of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Less;

impl Operation for Less {
    fn role(&self) -> &'static str {
        "less"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let joint = Type::joint(args)?;
        if joint.signed { Ok(Type::FLAG) } else { Err(format!("expected signed numbers, found {joint}")) }
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        i128::from(args[0] < args[1])
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let [a, b] = [args[0], args[1]];
        (i128::from(a.1 < b.0), i128::from(a.0 < b.1))
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = i64::from(a < b));
        true
    }

    fn delay(&self, device: &Device, args: &[Type], _: Type) -> f64 {
        device.chain(args.iter().map(|t| t.bits).max().unwrap_or(0) + 1)
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        let bits = args[0].bits.len().max(args[1].bits.len()) as u32 + 1;
        let minus: Vec<Bit> = args[1].resized(bits).into_iter().map(|b| !b).collect();
        vec![words.add(&args[0].resized(bits), &minus, Bit::ONE)[bits as usize - 1]]
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        // The function takes two numbers of one length.
        let bits = args[0].ty.bits.max(args[1].ty.bits);
        let longer = |operand: &Operand| operand.resized(Type { bits, ..operand.ty });
        Expression::call("less", [longer(&args[0]), longer(&args[1])])
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("<", args);
        (Kind::Comparison, long, short)
    }

    fn samples() -> Vec<Sample> {
        let s = |bits| Type::signed(bits, 0);
        vec![Sample::new(Self, &[s(4), s(4)]), Sample::new(Self, &[s(3), s(5)])]
    }
}
