use super::*;

/// Appends this many zeros below. The value stays, with as many fraction bits more; where it has no binary point, it is
/// multiplied by a power of two.
#[derive(Clone, Debug, PartialEq)]
pub struct Append(pub u32);

impl Operation for Append {
    fn role(&self) -> &'static str {
        "aligned"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let a = args[0];
        Ok(Type { bits: a.bits + self.0, fraction: a.fraction.map(|f| f + self.0 as i32), ..a })
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0] << self.0
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (args[0].0 << self.0, args[0].1 << self.0)
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = a << self.0);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        [number(0, self.0), args[0].bits.clone()].concat()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        if args[0].ty.is_flag() {
            let wide = args[0].resized(to);
            return Expression::call("shift_left", [wide, Expression::Integer(i128::from(self.0))]);
        }
        Expression::call("append", [args[0].value.clone(), Expression::Integer(i128::from(self.0))])
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        let text = format!("{} zeros appended", self.0);
        (Kind::Wire, text.clone(), text)
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self(2), &[Type::signed(4, 1)]), Sample::new(Self(1), &[Type::unsigned(3)]), Sample::new(Self(2), &[Type::FLAG])]
    }
}
