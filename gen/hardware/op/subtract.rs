use super::*;

/// Exact difference, signed, one bit wider than its operands, or in so many bits, where range analysis shows that it fits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subtract(pub Option<u32>);

impl Operation for Subtract {
    fn role(&self) -> &'static str {
        "difference"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let joint = Type::joint(args)?;
        Ok(Type { signed: true, bits: self.0.unwrap_or(joint.bits + 1), ..joint })
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        let exact = args[0] - args[1];
        if self.0.is_some() { to.wrap(exact) } else { exact }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (args[0].0 - args[1].1, args[0].1 - args[1].0)
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = a - b);
        wrapped(self.0, to, results);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.chain(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        let minus: Vec<Bit> = args[1].resized(to.bits).into_iter().map(|b| !b).collect();
        words.add(&args[0].resized(to.bits), &minus, Bit::ONE)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        args[0].resized(to).binary("-", args[1].resized(to))
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("\u{2212}", args);
        (Kind::Sum, long, short)
    }

    fn samples() -> Vec<Sample> {
        let (s, u) = (|bits| Type::signed(bits, 2), Type::unsigned(4));
        [[s(4), s(4)], [s(3), s(5)], [u, u]].map(|types| Sample::new(Self::default(), &types)).to_vec()
    }
}
