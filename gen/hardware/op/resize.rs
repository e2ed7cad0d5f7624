use super::*;

/// The same value in another type, with the same binary point or none: range analysis must show that nothing is lost.
#[derive(Clone, Debug, PartialEq)]
pub struct Resize(pub Type);

impl Operation for Resize {
    fn role(&self) -> &'static str {
        "resized"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let from = args[0].fraction;
        if self.0.fraction.is_some() && from.is_some() && self.0.fraction != from {
            return Err(format!("expected the binary point of {}, found {}", args[0], self.0));
        }
        Ok(self.0)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        self.0.wrap(args[0])
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        args[0]
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = to.wrap(i128::from(*a)) as i64);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        args[0].resized(to.bits)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        args[0].resized(to)
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        (Kind::Wire, String::new(), String::new())
    }

    fn samples() -> Vec<Sample> {
        let (s, u) = (|bits| Type::signed(bits, 1), Type::unsigned);
        vec![Sample::new(Self(s(6)), &[s(4)]), Sample::new(Self(s(3)), &[s(5)]), Sample::new(Self(s(5)), &[u(3)]), Sample::new(Self(u(4)), &[u(6)])]
    }
}
