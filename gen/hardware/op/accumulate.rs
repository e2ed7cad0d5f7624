use super::*;

/// Exact sum or difference of what was there before and a product, in the adder behind the hardware multiplier: one bit wider
/// than its operands, with a register of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulate {
    /// Whether the product is taken away.
    pub minus: bool,
}

impl Operation for Accumulate {
    fn role(&self) -> &'static str {
        "accumulated"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let joint = Type::joint(args)?;
        if !joint.signed {
            return Err(format!("expected signed numbers, found {joint}"));
        }
        Ok(Type { bits: joint.bits + 1, ..joint })
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        if self.minus { args[0] - args[1] } else { args[0] + args[1] }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let [a, b] = [args[0], args[1]];
        if self.minus { (a.0 - b.1, a.1 - b.0) } else { (a.0 + b.0, a.1 + b.1) }
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        let pairs = results.iter_mut().zip(args[0]).zip(args[1]);
        pairs.for_each(|((z, a), b)| *z = if self.minus { a - b } else { a + b });
        true
    }

    fn delay(&self, device: &Device, _: &[Type], _: Type) -> f64 {
        device.product_launch()
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        words.accumulate([&args[0], &args[1]].map(|word| word.resized(to.bits)), self.minus)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        let [a, b] = [0, 1].map(|k| args[k].resized(to));
        if self.minus { a.binary("-", b) } else { a.plus(b) }
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix(if self.minus { "\u{2212}" } else { "+" }, args);
        (Kind::Sum, long, short)
    }

    fn samples() -> Vec<Sample> {
        let s = |bits| Type::signed(bits, 2);
        [false, true]
            .into_iter()
            .flat_map(|minus| [[s(4), s(4)], [s(5), s(3)]].map(|types| Sample::new(Self { minus }, &types)))
            .collect()
    }
}
