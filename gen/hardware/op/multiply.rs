use super::*;

/// Exact product of signed operands, as wide as both together: one hardware multiplier if both fit it.
#[derive(Clone, Debug, PartialEq)]
pub struct Multiply;

impl Operation for Multiply {
    fn role(&self) -> &'static str {
        "product"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let [a, b] = [args[0], args[1]];
        if !a.signed || !b.signed {
            return Err(format!("expected signed factors, found {a} and {b}"));
        }
        let fraction = a.fraction.zip(b.fraction).map(|(a, b)| a + b);
        Ok(Type { signed: true, bits: a.bits + b.bits, fraction })
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0] * args[1]
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let [a, b] = [args[0], args[1]];
        hull([a.0 * b.0, a.0 * b.1, a.1 * b.0, a.1 * b.1].map(|x| (x, x)))
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = a * b);
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.product(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        words.multiply(args, to.bits)
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        args[0].value.clone().binary("*", args[1].value.clone())
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        let (long, short) = infix("\u{d7}", args);
        (Kind::Product, long, short)
    }

    fn samples() -> Vec<Sample> {
        let s = |bits| Type::signed(bits, 1);
        vec![Sample::new(Self, &[s(4), s(4)]), Sample::new(Self, &[s(3), s(5)])]
    }
}
