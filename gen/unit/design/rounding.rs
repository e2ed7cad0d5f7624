//! Rounding outward: the lower bound toward minus infinity, the upper bound toward plus infinity.

use super::interval::Interval;
use crate::params::{FormatRow, Params};
use efsat_hardware::graph::{Fact, Phases, Sig, Signals, Top};
use efsat_hardware::number::Upper;
use efsat_hardware::op::{Select, Type};

/// How a value is brought to its format: low bits dropped outward (negative: zeros appended), then saturated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rounding {
    /// Low bits dropped.
    pub drop: i32,
    /// Bound on the true value, and its lemma.
    pub saturate: Option<(i128, &'static str)>,
}

impl Rounding {
    /// From so many fraction bits to a row's format.
    pub fn to_row(fraction: i32, row: &FormatRow) -> Self {
        Self { drop: fraction - row.format.fraction, saturate: row.clamp.map(|c| (c.bound, c.lemma)) }
    }
}

/// The roundings that a unit is shared by, and which of them is in force.
#[derive(Clone)]
pub struct Roundings<'l> {
    /// The different ones.
    ways: Vec<Rounding>,
    /// The number of the one in force, if there are several.
    pub select: Option<Sig<'l>>,
    /// Rule for upper bounds; without one they are rounded down.
    upper: Option<Upper>,
    /// Type of the result.
    ty: Type,
}

impl<'l> Roundings<'l> {
    /// One rounding, to a type.
    pub fn one(way: Rounding, upper: Upper, ty: Type) -> Self {
        Self { ways: vec![way], select: None, upper: Some(upper), ty }
    }

    /// A rounding per phase, to the working width; `all` are the ones of all units that are to be alike.
    pub fn by_phase(p: &Params, all: &[Rounding], phases: &Phases<Rounding>, unit: Top<'l>, name: &str) -> Self {
        let mut ways: Vec<Rounding> = vec![];
        all.iter().for_each(|way| {
            if !ways.contains(way) {
                ways.push(*way)
            }
        });
        let number = phases.map(|way| ways.iter().position(|w| w == way).expect("one of all") as i128);
        let select = (ways.len() > 1).then(|| number.constant(unit, Type::index(ways.len())).named(name));
        Self { ways, select, upper: Some(p.upper), ty: working(p) }
    }

    /// The same for projections, the widest of which has so many bits.
    pub fn of_projections(self, p: &Params, bits: u32) -> Self {
        Self { upper: p.projection_upper(), ty: Type { bits, ..self.ty }, ..self }
    }

    /// The same, chosen by another signal: a port of the unit that rounds.
    pub fn selected_by(&self, select: Option<Sig<'l>>) -> Self {
        Self { select, ..self.clone() }
    }
}

/// Rounded toward plus infinity by that many bits, by the rule for upper bounds.
pub fn round_up<'l>(x: Sig<'l>, drop: u32, upper: Upper) -> Sig<'l> {
    let floor = x.floor(drop as i32);
    match upper {
        // floor + ulp (equation 5)
        Upper::Implied => (floor + floor.block().constant(1, Type::FLAG)).called("up"),
        // Exact ceiling: floor + OR of the dropped bits.
        Upper::Sticky => (floor + x.low(drop).any().called("inexact")).called("up").known(Fact::Ceiling(drop), &[x]),
    }
}

/// A number of the working width whose binary point depends on the phase.
pub fn working(p: &Params) -> Type {
    Type { signed: true, bits: p.width, fraction: None }
}

impl<'l> Interval<Sig<'l>> {
    /// Rounded outward by the rounding in force.
    pub fn round_outward(self, roundings: &Roundings<'l>) -> Self {
        let ways: Vec<Self> = roundings.ways.iter().map(|way| self.rounded(*way, roundings.upper)).collect();
        let end = |of: fn(&Self) -> Sig<'l>| match roundings.select {
            None => of(&ways[0]).resize(roundings.ty),
            Some(select) => {
                let ways: Vec<Sig<'l>> = ways.iter().map(|way| of(way).at_point(None)).collect();
                select.apply(Select::default(), &ways).resize(roundings.ty)
            }
        };
        Self { lo: end(|x| x.lo), hi: end(|x| x.hi) }
    }

    fn rounded(self, way: Rounding, upper: Option<Upper>) -> Self {
        let lo = self.lo.floor(way.drop);
        let hi = match upper {
            Some(upper) if way.drop > 0 => round_up(self.hi, way.drop as u32, upper),
            _ => self.hi.floor(way.drop),
        };
        let saturated = |x: Sig<'l>| match way.saturate {
            Some((bound, lemma)) => x.saturate(bound, lemma),
            None => x,
        };
        Self { lo: saturated(lo), hi: saturated(hi) }
    }
}
