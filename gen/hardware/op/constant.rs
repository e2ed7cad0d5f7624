use super::*;

/// A constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant(pub i128, pub Type);

impl Operation for Constant {
    fn role(&self) -> &'static str {
        "constant"
    }

    fn result(&self, _: &[Type]) -> Result<Type, String> {
        if !self.1.holds((self.0, self.0)) {
            return Err(format!("expected {} to fit {}", self.0, self.1));
        }
        Ok(self.1)
    }

    fn value(&self, _: &[i128], _: &[Type], _: Type) -> i128 {
        self.0
    }

    fn range(&self, _: &[Range], _: &[Type], _: Type) -> Range {
        (self.0, self.0)
    }

    fn lanes(&self, _: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.fill(self.0 as i64);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, _: &[Word], to: Type) -> Vec<Bit> {
        number(self.0, to.bits)
    }

    fn vhdl(&self, _: &[Operand], to: Type) -> Expression {
        Expression::Number(self.0, to)
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        (Kind::Wire, self.0.to_string(), self.0.to_string())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self(-3, Type::signed(4, 0)), &[]), Sample::new(Self(1, Type::FLAG), &[])]
    }
}
