use super::*;

/// Multiplied by a power of two, in as many bits: what is shifted out must be known to be nothing but signs.
#[derive(Clone, Debug, PartialEq)]
pub struct ShiftLeft(pub u32);

impl Operation for ShiftLeft {
    fn role(&self) -> &'static str {
        "shifted"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        if self.0 >= args[0].bits {
            return Err(format!("expected to shift {} by less than its width, found {}", args[0], self.0));
        }
        Ok(args[0])
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        to.wrap(args[0] << self.0)
    }

    fn range(&self, args: &[Range], _: &[Type], to: Type) -> Range {
        let shifted = (args[0].0 << self.0, args[0].1 << self.0);
        if to.holds(shifted) { shifted } else { to.limits() }
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = to.wrap(i128::from(*a) << self.0) as i64);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        let kept = (to.bits - self.0) as usize;
        [number(0, self.0), args[0].bits[..kept].to_vec()].concat()
    }

    fn vhdl(&self, args: &[Operand], _: Type) -> Expression {
        Expression::call("shift_left", [args[0].value.clone(), Expression::Integer(i128::from(self.0))])
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        let text = format!("shifted left by {}", self.0);
        (Kind::Wire, text.clone(), text)
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self(2), &[Type::signed(5, 1)]), Sample::new(Self(1), &[Type::unsigned(4)])]
    }
}
