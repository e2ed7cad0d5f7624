use super::*;

/// Exact sum, one bit wider than its operands (an unsigned operand takes one more to become signed), or in so many bits,
/// where range analysis shows that it fits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Add(pub Option<u32>);

impl Operation for Add {
    fn role(&self) -> &'static str {
        "sum"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let [a, b] = [args[0], args[1]];
        let signed = a.signed || b.signed;
        let bits = [a, b].map(|t| t.bits + u32::from(signed && !t.signed)).into_iter().max().unwrap_or(1);
        Ok(Type { signed, bits: self.0.unwrap_or(bits + 1), fraction: common_point(a, b)? })
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        let exact = args[0] + args[1];
        if self.0.is_some() { to.wrap(exact) } else { exact }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (args[0].0 + args[1].0, args[0].1 + args[1].1)
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = a + b);
        wrapped(self.0, to, results);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.chain(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        words.add(&args[0].resized(to.bits), &args[1].resized(to.bits), Bit::ZERO)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        args[0].resized(to).plus(args[1].resized(to))
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("+", args);
        (Kind::Sum, long, short)
    }

    fn samples() -> Vec<Sample> {
        let s = |bits| Type::signed(bits, 2);
        [[s(4), s(4)], [s(3), s(5)], [s(5), Type::FLAG], [Type::unsigned(3), Type::unsigned(4)]]
            .map(|types| Sample::new(Self::default(), &types))
            .to_vec()
    }
}
