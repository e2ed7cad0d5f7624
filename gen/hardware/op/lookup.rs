use super::*;

/// A constant table indexed by an unsigned operand, which never goes beyond its end; the model reads the last entry there.
#[derive(Clone, Debug, PartialEq)]
pub struct Lookup(pub Vec<i128>, pub Type);

impl Operation for Lookup {
    fn role(&self) -> &'static str {
        "entry"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        if self.0.is_empty() || self.0.len() > 1 << args[0].bits || args[0].signed {
            return Err(format!("expected an index of a table of {}, found {}", self.0.len(), args[0]));
        }
        Ok(self.1)
    }

    fn value(&self, args: &[i128], _: &[Type], _: Type) -> i128 {
        self.0[(args[0] as usize).min(self.0.len() - 1)]
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let last = self.0.len() as i128 - 1;
        hull((args[0].0.min(last)..=args[0].1.min(last)).map(|i| (self.0[i as usize], self.0[i as usize])))
    }

    fn lanes(&self, args: &[&[i64]], _: Type, results: &mut [i64]) -> bool {
        let last = self.0.len() - 1;
        results.iter_mut().zip(args[0]).for_each(|(z, a)| *z = self.0[(*a as usize).min(last)] as i64);
        true
    }

    fn delay(&self, device: &Device, args: &[Type], _: Type) -> f64 {
        device.tree(args[0].bits)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        (0..to.bits).map(|bit| words.lookup(&self.0, bit, &args[0].bits)).collect()
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        if args[0].ty.is_flag() {
            // A flag is no number that an array could be indexed with.
            let entry = |i: usize| Expression::Number(self.0[i.min(self.0.len() - 1)], to);
            return Expression::Select(Box::new(args[0].clone()), vec![entry(0), entry(1)]);
        }
        Expression::Table { name: String::new(), entries: self.0.clone(), ty: to, index: Box::new(args[0].clone()) }
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        (Kind::Logic, format!("table[{}]", args[0]), "table".to_owned())
    }

    fn samples() -> Vec<Sample> {
        let u = Type::unsigned;
        vec![Sample::new(Self(vec![0, 1, 1, 0, 1, 0, 0, 1], Type::FLAG), &[u(3)]), Sample::new(Self(vec![3, 1, 2], u(2)), &[u(2)])]
    }
}
