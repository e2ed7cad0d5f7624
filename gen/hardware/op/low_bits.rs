use super::*;

/// This many low bits, unsigned, keeping the binary point.
#[derive(Clone, Debug, PartialEq)]
pub struct LowBits(pub u32);

impl Operation for LowBits {
    fn role(&self) -> &'static str {
        "low"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let a = args[0];
        if self.0 == 0 || self.0 >= a.bits {
            return Err(format!("expected 1 to {} low bits of {a}, found {}", a.bits - 1, self.0));
        }
        Ok(Type { signed: false, bits: self.0, fraction: a.fraction })
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        args[0] & to.limits().1
    }

    fn range(&self, args: &[Range], _: &[Type], to: Type) -> Range {
        let (least, most) = args[0];
        if least >= 0 && most <= to.limits().1 { args[0] } else { to.limits() }
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        let ones = to.limits().1 as i64;
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = a & ones);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        args[0].bits[..self.0 as usize].to_vec()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        let value = args[0].value.clone();
        if to.is_flag() {
            return value.bit(0);
        }
        let slice = value.slice(self.0 - 1, 0);
        if args[0].ty.signed { Expression::call("unsigned", [slice]) } else { slice }
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        let text = format!("low {} bits", self.0);
        (Kind::Wire, text.clone(), text)
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self(2), &[Type::signed(6, 4)]), Sample::new(Self(1), &[Type::unsigned(5)])]
    }
}
