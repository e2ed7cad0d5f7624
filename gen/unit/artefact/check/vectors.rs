//! Vectors: poses and pairs as the ports of the top take them, with what the reference model answers.
//!
//! The file begins with the line of formats, which the testbench compares with its own; lines that begin with `#` are
//! comments. Then one record per line, in hexadecimal, the first port of its channel in the low bits: `P <pose>` and
//! `V <pair> <answer>`, the answer being verdict, separated, overlapping and, of a unit with a guard, outside from the
//! low bits up.

use crate::design::top::{pair_ports, pose_ports};
use crate::golden::Golden;
use crate::pair::{Input, Outcome, Pair, Pose};
use crate::params::{Method, Params, Transform, options::Choice};
use efsat_hardware::number::Upper;

/// What a design is driven with: poses, and the pairs under each.
#[derive(Clone, Debug, Default)]
pub struct Stimulus {
    /// In this order.
    pub segments: Vec<(Pose, Vec<Pair>)>,
}

impl Stimulus {
    /// Number of pairs.
    pub fn pairs(&self) -> usize {
        self.segments.iter().map(|s| s.1.len()).sum()
    }
}

/// A word of named fields, the first in the low bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Word {
    /// Name, value and bits of each field.
    pub fields: Vec<(String, i128, u32)>,
}

impl Word {
    fn number(&mut self, p: &Params, name: &str, x: Input) {
        self.fields.push((name.to_owned(), i128::from(x.lo), p.transform_width));
        if p.upper == Upper::Sticky {
            self.fields.push((format!("{name}_sticky"), i128::from(x.sticky), 1));
        }
    }

    /// All bits.
    pub fn bits(&self) -> u32 {
        self.fields.iter().map(|f| f.2).sum()
    }

    /// The word in hexadecimal, most significant digit first.
    pub fn hex(&self) -> String {
        let bits = self.fields.iter().flat_map(|(_, value, bits)| (0..*bits).map(move |i| (value >> i) & 1 == 1));
        let bits: Vec<bool> = bits.collect();
        let digit = |nibble: &[bool]| {
            let value = nibble.iter().rev().fold(0, |v, b| 2 * v + u32::from(*b));
            char::from_digit(value, 16).unwrap_or('0')
        };
        bits.chunks(4).rev().map(digit).collect()
    }
}

/// The pair's fields: every input port of the pair but the tag.
pub fn pair_word(p: &Params, pair: &Pair) -> Word {
    let mut word = Word::default();
    let points = pair.a.iter().chain(&pair.b).flatten();
    for (name, x) in pair_ports().iter().zip(points) {
        word.number(p, name, *x);
    }
    word
}

/// The pose's fields: every input port of the pose. Empty without a transform.
pub fn pose_word(p: &Params, pose: &Pose) -> Word {
    let mut word = Word::default();
    let entries = if p.transform == Transform::On { pose.m.iter().flatten() } else { [].iter().flatten() };
    for (name, x) in pose_ports(p).iter().zip(entries.chain(&pose.t)) {
        word.number(p, name, *x);
    }
    if p.transform != Transform::Off {
        word.fields.push(("pose_bypass".to_owned(), i128::from(pose.bypass), 1));
    }
    word
}

/// The answer's fields: the output ports of the verdict but the tag.
pub fn answer_word(p: &Params, outcome: &Outcome) -> Word {
    let flags = p.flags();
    let mut fields = vec![
        ("out_verdict", outcome.verdict as i128, 2),
        ("out_separated", i128::from(outcome.separated), flags),
        ("out_overlapping", i128::from(outcome.overlapping), flags),
    ];
    if p.guarded() {
        fields.push(("out_outside", i128::from(outcome.outside), 1));
    }
    Word { fields: fields.into_iter().map(|(name, value, bits)| (name.to_owned(), value, bits)).collect() }
}

/// The first line of a vector file, also a constant of the testbench.
pub fn formats_line(p: &Params) -> String {
    let upper = match p.upper {
        Upper::Implied => "implied",
        Upper::Sticky => "sticky",
    };
    let transform = match p.transform {
        Transform::On => "on",
        Transform::Translate => "translate",
        Transform::Off => "off",
    };
    let guard = if p.guarded() { " guard" } else { "" };
    let (input, width) = (p.input(), p.width);
    match p.method {
        Method::Axes => {
            let axes = p.axes.count();
            format!(
                "efsat vectors 1: input {input} upper {upper} transform {transform} width {width} axes {axes}{guard}"
            )
        }
        Method::Determinants => {
            let Params { span, levels, bound, boxes, .. } = p;
            let (bound, boxes) = (bound.name(), boxes.name());
            format!(
                "efsat vectors 1: determinants input {input} transform {transform} width {width} span {span} levels {levels} \
                 bound {bound} boxes {boxes}{guard}"
            )
        }
        Method::Exact => format!("efsat vectors 1: exact input {input} transform {transform} width {width}{guard}"),
    }
}

/// The vector file of a stimulus, answers from the reference model.
pub fn text(p: &Params, stimulus: &Stimulus) -> String {
    let golden = Golden::new(p);
    let mut lines = vec![
        formats_line(p),
        "# P <pose> and V <pair> <answer>, hexadecimal, first port in the low bits; answers from the reference model"
            .to_owned(),
    ];
    for (pose, pairs) in &stimulus.segments {
        if p.transform != Transform::Off {
            lines.push(format!("P {}", pose_word(p, pose).hex()));
        }
        for pair in pairs {
            let outcome = golden.outcome(pose, pair);
            lines.push(format!("V {} {}", pair_word(p, pair).hex(), answer_word(p, &outcome).hex()));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}
