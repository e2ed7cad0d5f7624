use super::*;

/// The second operand, negated where the first, a flag, is set, in as many bits: range analysis must show that it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct NegateIf;

impl Operation for NegateIf {
    fn role(&self) -> &'static str {
        "signed"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        if !args[0].is_flag() || !args[1].signed {
            return Err(format!("expected a flag and a signed number, found {} and {}", args[0], args[1]));
        }
        Ok(args[1])
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        if args[0] == 1 { -args[1] } else { args[1] }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let negated = (-args[1].1, -args[1].0);
        match args[0] {
            (0, 0) => args[1],
            (1, 1) => negated,
            _ => hull([args[1], negated]),
        }
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).zip(args[1]).for_each(|((z, a), b)| *z = if *a == 1 { -b } else { *b });
        true
    }

    fn delay(&self, device: &Device, _: &[Type], to: Type) -> f64 {
        device.conditional_negation(to.bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        words.negate_if(args[0].bits[0], &args[1].bits)
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        Expression::call("negated_if", [args[0].value.clone(), args[1].value.clone()])
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Sum, format!("{0} ? \u{2212}{1} : {1}", args[0], args[1]), "c ? \u{2212}a : a".to_owned())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self, &[Type::FLAG, Type::signed(5, 0)])]
    }
}
