use super::*;

/// The same value a clock later: a register where the scheduler has no choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Delay;

impl Operation for Delay {
    fn role(&self) -> &'static str {
        "delayed"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        Ok(args[0])
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        args[0]
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        args[0]
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        results.copy_from_slice(args[0]);
        true
    }

    fn delay(&self, _: &Device, _: &[Type], _: Type) -> f64 {
        0.0
    }

    fn gates(&self, _: &mut Words, args: &[Word], _: Type) -> Vec<Bit> {
        args[0].bits.clone()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        args[0].resized(to)
    }

    fn picture(&self, _: &[String]) -> (Kind, String, String) {
        (Kind::Wire, String::new(), String::new())
    }

    fn samples() -> Vec<Sample> {
        vec![Sample::new(Self, &[Type::signed(4, 1)]), Sample::new(Self, &[Type::FLAG])]
    }
}
