use super::*;

/// Exact negation, signed, one bit wider than its operand, or in so many bits, where range analysis shows that it fits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Negate(pub Option<u32>);

impl Operation for Negate {
    fn role(&self) -> &'static str {
        "negative"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        Ok(Type { signed: true, bits: self.0.unwrap_or(args[0].bits + 1), ..args[0] })
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        let exact = -args[0];
        if self.0.is_some() { to.wrap(exact) } else { exact }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (-args[0].1, -args[0].0)
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = -a);
        wrapped(self.0, to, results);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.chain(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        let minus: Vec<Bit> = args[0].resized(to.bits).into_iter().map(|b| !b).collect();
        words.add(&number(0, to.bits), &minus, Bit::ONE)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        Expression::unary("-", args[0].resized(to))
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Sum, format!("\u{2212}{}", args[0]), "\u{2212}a".to_owned())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self::default(), &[Type::signed(5, 1)]), Sample::new(Self::default(), &[Type::unsigned(4)])]
    }
}
