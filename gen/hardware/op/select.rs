use super::*;

/// The operand chosen by an unsigned first one: 0 takes the first of the others. In so many bits, where range analysis
/// shows that what is chosen fits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Select(pub Option<u32>);

impl Operation for Select {
    fn role(&self) -> &'static str {
        "choice"
    }

    fn result(&self, args: &[Type]) -> Result<Type, String> {
        let joint = Type::joint(&args[1..])?;
        Ok(Type { bits: self.0.unwrap_or(joint.bits), ..joint })
    }

    fn value(&self, args: &[i128], _: &[Type], to: Type) -> i128 {
        let chosen = args[1 + (args[0] as usize).min(args.len() - 2)];
        if self.0.is_some() { to.wrap(chosen) } else { chosen }
    }

    fn range(&self, args: &[Range], _: &[Type], _: Type) -> Range {
        let last = args.len() as i128 - 2;
        hull(args[1 + args[0].0.min(last) as usize..=1 + args[0].1.min(last) as usize].iter().copied())
    }

    fn lanes(&self, args: &[&[i64]], to: Type, results: &mut [i64]) -> bool {
        let (index, legs) = (args[0], &args[1..]);
        let last = legs.len() - 1;
        results.iter_mut().zip(index).enumerate().for_each(|(t, (z, i))| *z = legs[(*i as usize).min(last)][t]);
        wrapped(self.0, to, results);
        true
    }

    fn delay(&self, device: &Device, args: &[Type], _: Type) -> f64 {
        device.mux(args.len() - 1)
    }

    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit> {
        let legs: Vec<Vec<Bit>> = args[1..].iter().map(|leg| leg.resized(to.bits)).collect();
        words.select(&args[0].bits, &legs)
    }

    fn vhdl(&self, args: &[Operand], to: Type) -> Expression {
        let legs = args[1..].iter().map(|leg| leg.resized(to)).collect();
        Expression::Select(Box::new(args[0].clone()), legs)
    }

    fn picture(&self, args: &[String]) -> (Kind, String, String) {
        if let [flag, clear, set] = args {
            return (Kind::Multiplexer, format!("{flag} ? {set} : {clear}"), "c ? a : b".to_owned());
        }
        let text = format!("one of {}", args.len() - 1);
        (Kind::Multiplexer, format!("{text} by {}", args[0]), text)
    }

    fn samples() -> Vec<Sample> {
        let s = |bits| Type::signed(bits, 0);
        vec![Sample::new(Self::default(), &[Type::FLAG, s(3), s(3)]), Sample::new(Self::default(), &[Type::unsigned(2), s(2), s(3), s(2)])]
    }
}
