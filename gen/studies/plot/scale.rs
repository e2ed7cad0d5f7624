//! Axes: from numbers to pixels, and where ticks are.

/// A kind of axis, with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub label: String,
    pub logarithmic: bool,
    /// What is written behind a tick's number.
    pub unit: &'static str,
}

impl Axis {
    pub fn linear(label: &str) -> Self {
        Self { label: label.to_owned(), logarithmic: false, unit: "" }
    }

    pub fn logarithmic(label: &str) -> Self {
        Self { logarithmic: true, ..Self::linear(label) }
    }

    pub fn with_unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }
}

/// An axis with its range on the screen.
#[derive(Clone, Debug)]
pub struct Scale {
    logarithmic: bool,
    unit: &'static str,
    range: [f64; 2],
    pixels: [f64; 2],
}

/// A tick: where, what is written, and whether it has a line of its own across the plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub at: f64,
    pub text: String,
}

impl Scale {
    /// A scale over these numbers between these pixels; those that a logarithmic axis has no place for are left out.
    pub fn new(axis: &Axis, numbers: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let legal = |x: &f64| x.is_finite() && (!axis.logarithmic || *x > 0.0);
        let (mut low, mut high) =
            numbers.filter(legal).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            (low, high) = (1.0, 10.0);
        }
        let range = if axis.logarithmic {
            let (low, high) = (low.log10(), high.log10());
            let pad = 0.05 * (high - low).max(0.6);
            [low - pad, high + pad]
        } else {
            let pad = 0.04 * (high - low).max(1e-9);
            [low - pad, high + pad]
        };
        Self { logarithmic: axis.logarithmic, unit: axis.unit, range, pixels }
    }

    /// The pixel of a number.
    pub fn at(&self, x: f64) -> f64 {
        let x = if self.logarithmic { x.log10() } else { x };
        let share = (x - self.range[0]) / (self.range[1] - self.range[0]);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }

    /// Ticks with room for their numbers, about one in so many pixels.
    pub fn ticks(&self, pixels: f64) -> Vec<Tick> {
        let count = ((self.pixels[1] - self.pixels[0]).abs() / pixels).max(2.0);
        let tick =
            |x: f64, digits: usize| Tick { at: self.at(x), text: format!("{}{}", grouped(x, digits), self.unit) };
        let [low, high] = self.range;
        if !self.logarithmic {
            // Where all numbers are one there is nothing to divide.
            let step = Some(nice((high - low) / count)).filter(|step| step.is_normal()).unwrap_or(1.0);
            let digits = (-step.log10().floor()).max(0.0) as usize;
            let first = (low / step).ceil() as i64;
            let last = (high / step).floor() as i64;
            return (first..=last).map(|i| tick(i as f64 * step, digits)).collect();
        }
        let decades = high - low;
        let steps: &[f64] = match () {
            () if decades * 7.0 <= count => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0],
            () if decades * 3.0 <= count => &[1.0, 2.0, 5.0],
            () if decades * 2.0 <= count => &[1.0, 3.0],
            () => &[1.0],
        };
        let mut ticks = vec![];
        for decade in low.floor() as i32..=high.ceil() as i32 {
            for step in steps {
                let x = step * 10f64.powi(decade);
                if (low..=high).contains(&x.log10()) {
                    let digits = -decade + i32::from(step.fract() != 0.0);
                    ticks.push(tick(x, digits.max(0) as usize));
                }
            }
        }
        ticks
    }
}

/// The least of 1, 2, 5 times a power of ten that is not less.
fn nice(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|x| x * power).find(|x| *x >= step * 0.999).unwrap_or(power)
}

/// A number with commas.
fn grouped(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let (whole, rest) = text.split_once('.').map_or((text.as_str(), None), |(w, r)| (w, Some(r)));
    let whole: u64 = whole.parse().unwrap_or(0);
    let whole = super::grouped(whole);
    rest.map_or(whole.clone(), |rest| format!("{whole}.{rest}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, numbers: &[f64], pixels: f64) -> Vec<String> {
        let scale = Scale::new(axis, numbers.iter().copied(), [0.0, 400.0]);
        scale.ticks(pixels).into_iter().map(|tick| tick.text).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(texts(&Axis::linear("x"), &[10.0, 32.0], 70.0), ["10", "15", "20", "25", "30"]);
        assert_eq!(
            texts(&Axis::logarithmic("x").with_unit(" %"), &[0.01, 40.0], 60.0),
            ["0.01 %", "0.1 %", "1 %", "10 %"]
        );
        assert_eq!(
            texts(&Axis::logarithmic("x"), &[50.0, 3000.0], 60.0),
            ["50", "100", "200", "500", "1,000", "2,000"]
        );
        assert_eq!(texts(&Axis::logarithmic("x"), &[0.4, 1.1], 60.0), ["0.4", "0.5", "0.7", "1"]);
        assert_eq!(texts(&Axis::logarithmic("x"), &[], 60.0).len(), 4);
    }
}
