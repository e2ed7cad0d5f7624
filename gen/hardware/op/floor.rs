use super::*;

/// Drops this many low bits: rounds toward minus infinity.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor(pub u32);

impl Operation for Floor {
    fn role(&self) -> &'static str {
        "floor"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let a = args[0];
        if self.0 == 0 || self.0 >= a.bits {
            return Err(format!("expected to drop 1 to {} bits of {a}, found {}", a.bits - 1, self.0));
        }
        Ok(Type { bits: a.bits - self.0, fraction: a.fraction.map(|f| f - self.0 as i32), ..a })
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0] >> self.0
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        (args[0].0 >> self.0, args[0].1 >> self.0)
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = a >> self.0);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        args[0].bits[self.0 as usize..].to_vec()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        let (value, top) = (args[0].value.clone(), args[0].ty.bits - 1);
        if to.is_flag() { value.bit(top) } else { value.slice(top, self.0) }
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        let text = format!("floor, {} bits dropped", self.0);
        (Kind::Wire, text.clone(), text)
    }

    fn samples() -> Vec<Sample> {
        let u = Type::unsigned(5);
        vec![Sample::new(Self(2), &[Type::signed(6, 4)]), Sample::new(Self(4), &[u]), Sample::new(Self(1), &[u])]
    }
}
