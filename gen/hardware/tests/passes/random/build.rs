//! From steps to a legal graph: operands are the values there are, brought into types that fit.

use super::case::{Case, Step};
use crate::{lowered_for, scheduled_for};
use efsat_hardware::entity;
use efsat_hardware::graph::{Block, Fact, Library, Phases, Rate, Sig, Signals, Top, Vec3};
use efsat_hardware::netlist::Module;
use efsat_hardware::netlist::lower::Probe;
use efsat_hardware::op::{Range, Select, Type};
use efsat_hardware::schedule::Schedule;
use efsat_hardware::{device, dump};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::rc::Rc;

efsat_hardware::record! {
    /// Two bounds.
    Bounds "bounds" { least: S, most: S }
}

/// A value, and where it has a meaning.
#[derive(Clone)]
struct Value<'l> {
    sig: Sig<'l>,
    meaning: Meaning,
    /// Whether it is made of what was captured in a late phase: then no late operand can be made of it.
    of_late: bool,
}

#[derive(Clone, PartialEq)]
enum Meaning {
    /// It does not change.
    Always,
    /// One for each pair.
    Pair,
    /// In some phases, and whether these are late ones.
    Phases(Vec<Option<bool>>),
}

impl Meaning {
    fn with(&self, other: &Self) -> Self {
        let of_pair = |p: &Vec<Option<bool>>| Self::Phases(p.iter().map(|late| late.filter(|late| !late)).collect());
        match (self, other) {
            (Self::Always, x) | (x, Self::Always) => x.clone(),
            (Self::Pair, Self::Pair) => Self::Pair,
            (Self::Pair, Self::Phases(p)) | (Self::Phases(p), Self::Pair) => of_pair(p),
            (Self::Phases(p), Self::Phases(q)) => {
                Self::Phases(p.iter().zip(q).map(|(p, q)| p.filter(|_| p == q)).collect())
            }
        }
    }

    /// The phases in which it has a meaning.
    fn phases(&self) -> Vec<(usize, bool)> {
        match self {
            Self::Always => vec![],
            Self::Pair => vec![(0, false)],
            Self::Phases(p) => p.iter().enumerate().filter_map(|(s, late)| late.map(|late| (s, late))).collect(),
        }
    }
}

struct Builder<'l> {
    top: Top<'l>,
    interval: usize,
    widest: u32,
    values: Vec<Value<'l>>,
    inputs: Vec<Range>,
    /// Whether every value has a name: else some have those that follow from the structure, which may clash.
    named: bool,
    count: Cell<usize>,
}

type Numbers = [usize; 4];

/// What can be done with values, the first two of which are given.
type Operation = for<'l> fn(&Builder<'l>, Sig<'l>, Sig<'l>, Numbers) -> Sig<'l>;

/// What is more than an operation on values.
type More = for<'l> fn(&mut Builder<'l>, Numbers);

/// The operations: name, and how many values they read.
const OPERATIONS: [(&str, usize, Operation); 28] = [
    ("add", 2, |b, x, y, _| {
        let (x, y) = if x.ty().signed == y.ty().signed { (x, y) } else { (b.signed(x, 60), b.signed(y, 60)) };
        x.at_point(None) + y.at_point(None)
    }),
    ("subtract", 2, |b, x, y, _| b.signed(x, 60) - b.signed(y, 60)),
    ("multiply", 2, |b, x, y, _| b.signed(x, b.widest / 2) * b.signed(y, b.widest / 2)),
    ("and", 2, |b, x, y, _| b.bitwise([x, y], |[x, y]| x & y)),
    ("or", 2, |b, x, y, _| b.bitwise([x, y], |[x, y]| x | y)),
    ("not", 1, |b, x, _, _| !b.unsigned(x, 60)),
    ("append", 1, |_, x, _, n| x.floor(-(1 + n[2] as i32 % 3))),
    ("floor", 1, |_, x, _, n| x.floor(n[2] as i32 % x.ty().bits as i32)),
    ("low", 1, |_, x, _, n| if x.ty().bits > 1 { x.low(1 + n[2] as u32 % (x.ty().bits - 1)) } else { x }),
    ("concatenate", 2, |b, x, y, _| b.unsigned(x, 20).below(&[y.at_point(None)])),
    ("equal", 2, |b, x, y, n| {
        if n[2].is_multiple_of(4) { x.equals(x.like(x.range().0)) } else { b.signed(x, 60).equals(b.signed(y, 60)) }
    }),
    ("less", 2, |b, x, y, _| b.signed(x, 60).less(b.signed(y, 60))),
    ("lookup", 1, |b, x, _, n| {
        let index = b.unsigned(x, 4);
        let signed = n[2].is_multiple_of(2);
        let ty = if signed { Type::signed(6, 0) } else { Type::unsigned(1 + n[3] as u32 % 5) };
        let (least, most) = ty.limits();
        let entry = |i: i128| least + (i * 37 + n[2] as i128 * 11) % (most - least + 1);
        index.lookup((0..=index.range().1).map(entry).collect(), ty)
    }),
    ("magnitude", 1, |b, x, _, _| b.signed(x, 60).magnitude()),
    ("negate", 1, |b, x, _, _| -b.signed(x, 60)),
    ("negate_if", 2, |b, x, y, _| {
        let x = b.signed(x, 60);
        // The least number has no opposite in as many bits.
        x.bits(x.ty().bits + 1).negate_if(b.flag(y))
    }),
    ("any", 1, |b, x, _, _| b.unsigned(x, 60).any()),
    ("resize", 1, |_, x, _, n| {
        let needed = (1..).find(|bits| Type { bits: *bits, ..x.ty() }.holds(x.range())).unwrap_or(0);
        x.bits(needed.max(2) + n[2] as u32 % 4)
    }),
    ("choose", 3, |b, x, y, n| b.flag(b.value(n[2]).sig).choose(b.signed(x, 60), b.signed(y, 60))),
    ("select", 4, |b, x, y, n| {
        let legs = [b.signed(x, 60), b.signed(y, 60), b.signed(b.value(n[3]).sig, 60)];
        b.unsigned(b.value(n[2]).sig, 2).resize(Type::unsigned(2)).apply(Select::default(), &legs)
    }),
    ("shift_left", 1, |_, x, _, n| {
        let fits = |bits: u32| bits < x.ty().bits && x.ty().holds((x.range().0 << bits, x.range().1 << bits));
        let most = (0..4).take_while(|bits| fits(*bits)).last().unwrap_or(0);
        if most == 0 { x } else { x.shift_left(1 + n[2] as u32 % most) }
    }),
    ("sign", 1, |b, x, _, _| b.signed(x, 60).negative()),
    ("plus", 3, |b, x, y, n| {
        let (x, y) = (b.signed(x, 20), b.signed(y, 20));
        x.plus(y, b.flag(b.value(n[2]).sig))
    }),
    ("saturate", 1, |b, x, _, n| {
        let x = b.signed(x, 60);
        x.saturate((x.ty().limits().1 >> (n[2] % 3)).max(1), "saturated")
    }),
    ("positive", 1, |b, x, _, _| b.signed(x, 60).positive(b.signed(x, 60).ty().bits - 1)),
    ("within", 1, |_, x, _, _| x.within(x.range(), "its range")),
    ("product", 2, |b, x, y, _| {
        let (x, y) = (b.signed(x, b.widest / 2), b.signed(y, b.widest / 2));
        (x * y).known(Fact::Product, &[x, y])
    }),
    ("ceiling", 1, |_, x, _, n| {
        let drop = 1 + n[2] as u32 % 3;
        if x.ty().bits <= drop {
            x
        } else {
            (x.floor(drop as i32).at_point(None) + x.low(drop).any()).known(Fact::Ceiling(drop), &[x])
        }
    }),
];

const OTHERS: [(&str, More); 19] = [
    (SECTION, |_, _| {}),
    ("input", |b, n| b.input(n)),
    ("steady", |b, n| {
        let (ty, range) = kind(n);
        let sig = b.top.steady(ty, range);
        b.inputs.push(range);
        b.keep(sig, Meaning::Always, false);
    }),
    ("constant", |b, n| {
        let (ty, range) = kind(n);
        let sig = b.top.constant(range.1, ty);
        // A number without a name of its own is written where it is read.
        b.values.push(Value { sig, meaning: Meaning::Always, of_late: false });
    }),
    ("phases", |b, n| {
        let (ty, (least, most)) = kind(n);
        let at =
            |s: usize| (s == 0 || (n[2] >> s) & 3 > 0).then(|| least + (s * (n[3] + 1)) as i128 % (most - least + 1));
        let phases = Phases::new(b.interval, at);
        let sig = phases.constant(b.top, ty);
        let meaning = Meaning::Phases(phases.marks().into_iter().map(|busy| busy.then_some(false)).collect());
        let changes = sig.rate() == Rate::Phase;
        if changes {
            b.keep(sig, meaning, false);
        }
    }),
    ("mux", |b, n| b.mux(n, false)),
    ("late_mux", |b, n| b.mux(n, true)),
    ("once", |b, n| {
        // One signal is a value of the pair and what is chosen in a phase.
        let (x, phase) = (b.pair(n[0]), n[1] % b.interval);
        let once = Phases::new(b.interval, |s| (s == phase).then_some(x.sig));
        let meaning = (0..b.interval).map(|s| (s == phase).then_some(false)).collect();
        b.keep(once.mux(), Meaning::Phases(meaning), x.of_late);
    }),
    ("wide_mux", |b, n| b.wide_mux(n)),
    ("capture", |b, n| b.capture(n)),
    ("capture_more", |b, n| (0..3).for_each(|k| b.capture([n[0], n[1] + k, n[2], n[3]]))),
    ("recall", |b, n| {
        // Values of one stream, in another order.
        let Some((value, _)) = b.stream(n[0]) else { return };
        let phases: Vec<usize> =
            value.meaning.phases().into_iter().filter(|(_, late)| !late).map(|(s, _)| s).take(5).collect();
        if phases.is_empty() {
            return;
        }
        let held = phases.iter().map(|s| value.sig.capture(*s, false)).collect::<Vec<_>>().named(&b.next());
        let again = Phases::new(b.interval, |s| {
            ((n[2] >> s) % 8 > 0 || s == 0).then(|| held[(s * (1 + n[1] % 2) + n[3]) % held.len()])
        });
        let meaning = again.marks().into_iter().map(|busy| busy.then_some(false)).collect();
        b.keep(again.mux(), Meaning::Phases(meaning), value.of_late);
    }),
    ("earlier", |b, n| {
        let Some((value, phases)) = b.stream(n[0]) else { return };
        let before = 1 + n[1] % b.interval;
        let meaning = (0..b.interval).map(|s| s.checked_sub(before).and_then(|s| phases[s])).collect();
        b.keep(value.sig.earlier(before), Meaning::Phases(meaning), value.of_late);
    }),
    ("scan", |b, n| {
        let Some((value, phases)) = b.stream(n[0]) else { return };
        let starts = |s: usize| s == n[1] % b.interval || (n[2] >> s) & 7 == 0;
        let first = Phases::new(b.interval, |s| Some(i128::from(starts(s)))).constant(b.top, Type::FLAG);
        // From a start on, as long as all phases have the one meaning.
        let mut so_far = None;
        let meaning = (0..b.interval).map(|s| {
            so_far = if starts(s) { phases[s] } else { phases[s].filter(|_| phases[s] == so_far) };
            so_far
        });
        let meaning = Meaning::Phases(meaning.collect());
        b.keep(b.unsigned(value.sig, 60).or_over_phases(first), meaning, value.of_late);
    }),
    ("share", |b, n| {
        let pair = |k: usize| [b.pair(n[0] + k), b.pair(n[1] + 2 * k)];
        let operands: Vec<[Value; 2]> = (0..2.min(b.interval)).map(pair).collect();
        let of_late = operands.iter().flatten().any(|value| value.of_late);
        let ty = Type::signed(8, 0);
        let phases = Phases::new(b.interval, |s| operands.get(s).map(|each| each.clone().map(|x| b.typed(x.sig, ty))));
        let [x, y] = phases.mux().map(|x| b.own(x));
        let product = b.own(x * y);
        let held: Vec<Sig> = phases.capture(&product).map(|(_, value)| value).collect();
        let held = if held.len() > 1 { held.named(&b.next()) } else { held };
        held.into_iter().for_each(|sig| b.plain(sig, Meaning::Pair, of_late));
    }),
    ("feedback", |b, n| {
        if b.interval < 2 {
            return;
        }
        let from = 1 + n[1] % (b.interval - 1);
        let first = b.find(n[0], |value| value.meaning == Meaning::Pair && !value.of_late);
        let ty = Type::signed(8, 0);
        let back = b.top.later(ty, ty.limits());
        let early = b.typed(first.sig, ty);
        let phases = Phases::new(b.interval, |s| Some((if s < from { early } else { back }, s >= from))).late(|x| x.1);
        let x = b.own(phases.map(|x| x.0).mux());
        let next =
            if n[2].is_multiple_of(2) { (x + x.like(3)).floor(1).at_point(ty.fraction) } else { b.typed(x * x, ty) };
        // Of the first pair's phases alone: what comes back is there before it is read.
        back.connect(next.capture(n[3] % from, false).named(&b.next()));
        b.keep(next, Meaning::Phases((0..b.interval).map(|s| Some(s >= from)).collect()), false);
    }),
    ("products", |b, n| {
        // A sum of products, some of them entities, one of them perhaps read elsewhere too.
        let entities = n[3] % 3 > 0;
        let first = |number: usize| if entities { b.changing(number) } else { b.value(number) };
        let pairs: Vec<[Value; 2]> = (0..2 + n[2] % 5).map(|k| [first(n[0] + k), b.value(n[1] + 2 * k)]).collect();
        let values = || pairs.iter().flatten();
        let meaning = values().fold(Meaning::Always, |meaning, value| meaning.with(&value.meaning));
        let ty = Type::signed(8, 0);
        let products = pairs.iter().map(|[x, y]| [x, y].map(|value| b.typed(value.sig, ty)));
        let products: Vec<Sig> =
            products.map(|[x, y]| if entities { part(0, x, y)[0] } else { b.own(x * y) }).collect();
        let mut sum = products[0];
        for (k, product) in products[1..].iter().enumerate() {
            sum = b.own(if (n[3] >> k) & 3 == 3 { sum - *product } else { sum + *product });
        }
        if n[2] % 3 == 0 {
            sum = b.own(sum + sum.like(n[3] as i128 % 500 - 250));
        }
        let meaning = match (sum.rate(), meaning) {
            (Rate::Pair, _) => Meaning::Pair,
            (Rate::Phase, Meaning::Phases(phases)) => Meaning::Phases(phases),
            _ => return,
        };
        let of_late = values().any(|value| value.of_late);
        if n[2] % 4 == 0 && products[1].rate() == sum.rate() {
            b.keep(products[1], meaning.clone(), of_late);
        }
        b.keep(sum, meaning, of_late);
    }),
    ("instance", |b, n| {
        let (x, y) = (b.changing(n[0]), b.value(n[1]));
        let ty = Type::signed(8, 0);
        let results = part(n[2], b.typed(x.sig, ty), b.typed(y.sig, ty));
        let (meaning, of_late) = (x.meaning.with(&y.meaning), x.of_late || y.of_late);
        results.into_iter().for_each(|sig| b.keep(sig, meaning.clone(), of_late));
    }),
    ("bundle", |b, n| b.bundle(n)),
];

/// What begins a section, or ends one: the steps behind it are in it.
const SECTION: &str = "section";

/// The names of all steps.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    OPERATIONS.iter().map(|x| x.0).chain(OTHERS.iter().map(|x| x.0))
}

/// A type and the range of its values.
fn kind(n: Numbers) -> (Type, Range) {
    let bits = 2 + n[0] as u32 % 11;
    let ty = if !n[1].is_multiple_of(3) { Type::signed(bits, 0) } else { Type::unsigned(bits - 1) };
    let (least, most) = ty.limits();
    (ty, [(least, most), (least / 2, most), (least, most / 2), (0.max(least), most.min(5))][n[1] / 3 % 4])
}

/// One of a few entities.
fn part<'l>(which: usize, x: Sig<'l>, y: Sig<'l>) -> Vec<Sig<'l>> {
    match which % 4 {
        0 => vec![entity!("part_product", &["A product."], (x, y) => (x * y).named("p"))],
        1 => entity!("part_order", &["Both in order."], (x, y) => {
            let less = x.less(y).named("is_less");
            [less.choose(x, y).named("least"), less.choose(y, x).named("most")]
        })
        .to_vec(),
        2 => vec![entity!("part_sum", &["A sum."], (x, y) => (x + y).named("s"))],
        _ => vec![entity!("part_nested", &["An entity in it."], (x, y) => {
            let z = part(0, x, y)[0].floor(8).at_point(Some(0));
            (part(2, x, z)[0] - y).named("d")
        })],
    }
}

/// Signed numbers have two bits at least and a binary point, others have none.
fn normal(sig: Sig<'_>) -> Sig<'_> {
    match (sig.ty().signed, sig.ty().bits) {
        (true, 1) => sig.bits(2).at_point(Some(0)),
        (true, _) => sig.at_point(Some(0)),
        _ => sig.at_point(None),
    }
}

impl<'l> Builder<'l> {
    /// A value, 0 being the newest.
    fn value(&self, number: usize) -> Value<'l> {
        self.values[self.values.len() - 1 - number % self.values.len()].clone()
    }

    fn find(&self, number: usize, f: impl Fn(&Value<'l>) -> bool) -> Value<'l> {
        let all: Vec<&Value<'l>> = self.values.iter().rev().filter(|value| f(value)).collect();
        all[number % all.len()].clone()
    }

    /// A value that has no phases.
    fn pair(&self, number: usize) -> Value<'l> {
        self.find(number, |value| value.meaning == Meaning::Pair)
    }

    /// A value that is not the same for all pairs.
    fn changing(&self, number: usize) -> Value<'l> {
        self.find(number, |value| value.meaning != Meaning::Always)
    }

    /// A value of every phase with its meaning in each.
    fn stream(&self, number: usize) -> Option<(Value<'l>, Vec<Option<bool>>)> {
        let streams = self.values.iter().rev().filter_map(|value| match &value.meaning {
            Meaning::Phases(phases) if value.sig.rate() == Rate::Phase => Some((value.clone(), phases.clone())),
            _ => None,
        });
        let streams: Vec<_> = streams.collect();
        (!streams.is_empty()).then(|| streams[number % streams.len()].clone())
    }

    fn next(&self) -> String {
        self.count.set(self.count.get() + 1);
        format!("v{}", self.count.get())
    }

    /// Includes a value, with a name or without.
    fn keep(&mut self, sig: Sig<'l>, meaning: Meaning, of_late: bool) {
        let meaningless = meaning != Meaning::Always && meaning.phases().is_empty();
        let sig = normal(sig);
        if meaningless || self.values.iter().any(|value| value.sig == sig) || sig.ty().bits > self.widest {
            return;
        }
        let name = self.next();
        let sig = if self.named || !self.count.get().is_multiple_of(3) { sig.named(&name) } else { sig };
        self.plain(sig, meaning, of_late);
    }

    fn plain(&mut self, sig: Sig<'l>, meaning: Meaning, of_late: bool) {
        let sig = normal(sig);
        self.values.push(Value { sig, meaning, of_late });
    }

    fn input(&mut self, n: Numbers) {
        let (ty, range) = kind(n);
        self.inputs.push(range);
        let sig = self.top.input(ty, range).named(&self.next());
        self.plain(sig, Meaning::Pair, false);
    }

    /// Gives a name where all values have one.
    fn own(&self, x: Sig<'l>) -> Sig<'l> {
        if self.named { x.named(&self.next()) } else { x }
    }

    /// A step on the way to another type.
    fn step(&self, x: Sig<'l>, f: impl FnOnce(Sig<'l>) -> Sig<'l>) -> Sig<'l> {
        let made = f(x);
        if made != x { self.own(made) } else { x }
    }

    /// As a signed number of at most so many bits.
    fn signed(&self, x: Sig<'l>, most: u32) -> Sig<'l> {
        let ty = Type { signed: true, bits: x.ty().bits + 1, fraction: None };
        let x = if x.ty().signed { x } else { self.step(x, |x| x.resize(ty)) };
        let over = x.ty().bits.saturating_sub(most.max(2)) as i32;
        let x = self.step(x, |x| x.floor(over));
        self.step(x, |x| x.at_point(Some(0)))
    }

    /// As an unsigned number of at most so many bits.
    fn unsigned(&self, x: Sig<'l>, most: u32) -> Sig<'l> {
        let bits = if x.ty().signed { x.ty().bits - 1 } else { x.ty().bits };
        let x = if x.ty().signed || bits > most { self.step(x, |x| x.low(bits.min(most))) } else { x };
        self.step(x, |x| x.at_point(None))
    }

    fn flag(&self, x: Sig<'l>) -> Sig<'l> {
        self.step(x, |x| if x.ty().signed { x.negative() } else { x.any() })
    }

    fn bitwise(&self, both: [Sig<'l>; 2], f: impl FnOnce([Sig<'l>; 2]) -> Sig<'l>) -> Sig<'l> {
        let both = both.map(|x| self.unsigned(x, 60));
        let bits = both[0].ty().bits.max(both[1].ty().bits);
        f(both.map(|x| self.step(x, |x| x.bits(bits))))
    }

    /// As a number of a type: what has more bits loses the lowest.
    fn typed(&self, x: Sig<'l>, ty: Type) -> Sig<'l> {
        let x = if ty.signed { self.signed(x, ty.bits) } else { self.unsigned(x, ty.bits) };
        self.step(x, |x| x.resize(Type { fraction: x.ty().fraction, ..ty }))
    }

    fn operation(&mut self, reads: usize, f: Operation, n: Numbers) {
        let all = n.map(|number| self.value(number));
        let sig = f(self, all[0].sig, all[1].sig, n);
        let all = &all[..reads];
        let meaning = all.iter().fold(Meaning::Always, |meaning, value| meaning.with(&value.meaning));
        let of_late = all.iter().any(|value| value.of_late);
        let meaning = match (sig.rate(), meaning) {
            (Rate::Any, _) => Meaning::Always,
            (Rate::Pair, _) => Meaning::Pair,
            (Rate::Phase, Meaning::Phases(phases)) => Meaning::Phases(phases),
            (Rate::Phase, _) => return,
        };
        self.keep(sig, meaning, of_late);
    }

    fn mux(&mut self, n: Numbers, lates: bool) {
        // Up to four values, over the phases in an order that repeats some and leaves some idle.
        let values: Vec<Value<'l>> = (0..4).map(|k| self.value(n[0] + k * (1 + n[1] % 3))).collect();
        let bits = values.iter().map(|value| value.sig.ty().bits).max().unwrap_or(2).min(12);
        let ty = if n[3].is_multiple_of(2) { Type::signed(bits.max(2), 0) } else { Type::unsigned(bits) };
        let from = n[3] % self.interval;
        let take = |s: usize| {
            let k = (n[2] >> s) % 5;
            let value = values.get(k % 4).filter(|_| k < 4 || s == 0)?;
            let late = lates && s >= from && value.meaning == Meaning::Pair && !value.of_late;
            Some((self.typed(value.sig, ty), late, value))
        };
        let phases = Phases::new(self.interval, take).late(|x| x.1);
        let of_late = phases.busy().any(|(_, x)| x.2.of_late);
        let meaning = |s: usize| {
            let (_, late, value) = phases.get(s)?;
            match &value.meaning {
                Meaning::Always => Some(false),
                Meaning::Pair => Some(*late),
                Meaning::Phases(phases) => phases[s],
            }
        };
        let meaning = (0..self.interval).map(meaning).collect();
        let sig = phases.map(|x| x.0).mux();
        if sig.rate() == Rate::Phase {
            self.keep(sig, Meaning::Phases(meaning), of_late);
        }
    }

    /// Another value in each phase, after the elements of a bundle of inputs.
    fn wide_mux(&mut self, n: Numbers) {
        let ty = Type::signed(2 + n[0] as u32 % 8, 0);
        let elements: Vec<Sig<'l>> = (0..self.interval).map(|_| self.top.input(ty, ty.limits())).collect();
        self.inputs.extend(elements.iter().map(|_| ty.limits()));
        let elements = elements.named(&self.next());
        let phases = Phases::new(self.interval, |s| ((n[1] >> s) & 3 > 0 || s == 0).then(|| elements[s]));
        let meaning = phases.marks().into_iter().map(|busy| busy.then_some(false)).collect();
        self.keep(phases.mux(), Meaning::Phases(meaning), false);
        elements.into_iter().take(2).for_each(|sig| self.plain(sig, Meaning::Pair, false));
    }

    fn capture(&mut self, n: Numbers) {
        let Some((value, _)) = self.stream(n[0]) else { return };
        let phases = value.meaning.phases();
        let (phase, late) = phases[n[1] % phases.len()];
        self.keep(value.sig.capture(phase, late), Meaning::Pair, value.of_late || late);
    }

    /// What is done alike with several values.
    fn bundle(&mut self, n: Numbers) {
        let ty = Type::signed(3 + n[3] as u32 % 7, 0);
        let operands: Vec<Value<'l>> = (0..3).map(|k| self.changing(n[0] + k)).collect();
        let v = Vec3::each(|i| self.typed(operands[i].sig, ty));
        let meaning = operands.iter().fold(Meaning::Always, |meaning, value| meaning.with(&value.meaning));
        let of_late = operands.iter().any(|value| value.of_late);
        let name = self.next();
        let all: Vec<Sig<'l>> = match n[1] % 5 {
            0 => v.map(|x| x + v[0]).named(&name).signals(),
            1 => v.cross(v.map(|x| x + v[1])).named(&name).signals(),
            2 => v.map(|x| Bounds { least: x.floor(1), most: (x + v[2]).floor(1) }).named(&name).signals(),
            3 => v.0.iter().map(|x| x.negative()).collect::<Vec<_>>().named(&name),
            _ => {
                let wide = v.map(|x| self.typed(x, Type::signed(8, 0)));
                Vec3::each(|i| part(0, wide[i], wide[i + 1])[0]).named(&name).signals()
            }
        };
        // Each element has its own rate and its own meaning, and at least the common one.
        for sig in all {
            let meaning = match (sig.rate(), &meaning) {
                (Rate::Pair, _) => Meaning::Pair,
                (Rate::Phase, Meaning::Phases(phases)) if phases.iter().any(Option::is_some) => meaning.clone(),
                _ => continue,
            };
            if !self.values.iter().any(|value| value.sig == sig) {
                self.plain(sig, meaning, of_late);
            }
        }
    }
}

/// A design, and what is to be known of it.
pub struct Built {
    pub block: Rc<Block>,
    /// The range of each input.
    pub inputs: Vec<Range>,
    /// The phases in which each output has a meaning.
    pub outputs: Vec<Vec<(usize, bool)>>,
    pub schedule: Rc<Schedule>,
    pub module: Rc<Module>,
    pub probes: Vec<Probe>,
}

/// A graph, the range of each input, and the phases in which each output has a meaning.
type Graph = (Rc<Block>, Vec<Range>, Vec<Vec<(usize, bool)>>);

fn block(case: &Case, named: bool) -> Graph {
    let (mut inputs, mut meanings) = (vec![], vec![]);
    let library = Library::default();
    let block = library.block("design", &["Made at random."], case.interval, |top| {
        let mut b = Builder {
            top,
            interval: case.interval,
            widest: case.widest,
            values: vec![],
            inputs: vec![],
            named,
            count: Cell::default(),
        };
        (0..2).for_each(|k| b.input([6 + k, 1, 0, 0]));
        for (k, steps) in case.steps.chunk_by(|_, next| next.kind != SECTION).enumerate() {
            let take = |step: &Step| match OPERATIONS.iter().find(|x| x.0 == step.kind) {
                Some((_, reads, f)) => b.operation(*reads, *f, step.numbers),
                None => OTHERS.iter().find(|x| x.0 == step.kind).expect("a known kind").1(&mut b, step.numbers),
            };
            // Some are outside of sections.
            if steps[0].kind == SECTION && !steps[0].numbers[0].is_multiple_of(4) {
                top.section(&format!("section{k}"), &["Made at random."], || steps.iter().for_each(take));
            } else {
                steps.iter().for_each(take);
            }
        }
        inputs.clone_from(&b.inputs);
        // The newest values, and some of the others.
        // What comes in late phases leaves when it is captured: all of a pair is gone by the latency.
        let in_time = |value: &Value| value.meaning.phases().into_iter().filter(|(_, late)| !late).collect::<Vec<_>>();
        let made: Vec<&Value> = b.values.iter().rev().filter(|value| !in_time(value).is_empty()).collect();
        let chosen = made.iter().take(5).chain(made.iter().skip(5).step_by(3)).enumerate();
        let mut outputs = vec![];
        for (k, value) in chosen {
            let phases = in_time(value);
            let ty = value.sig.ty();
            // No input is an output.
            let sig = if k % 3 == 0 { value.sig.named(&b.next()).probe(&phases) } else { value.sig };
            let sig = sig.resize(Type { bits: ty.bits + 1, ..ty });
            outputs.push(sig.named(&format!("out{k}")));
            meanings.push(phases);
        }
        outputs
    });
    (block, inputs, meanings)
}

/// Builds, schedules and lowers the design of a case; nothing where two values would be called the same by the structure, even
/// with names for most of them.
pub fn build(case: &Case) -> Option<Built> {
    let device = device::names()[case.device % device::names().len()];
    let (block, inputs, outputs) = [false, true].into_iter().find_map(|named| {
        catch_unwind(AssertUnwindSafe(|| block(case, named))).map(Some).unwrap_or_else(|why| {
            let clash = why.downcast_ref::<String>().is_some_and(|why| why.contains("two nodes are called"));
            if clash { None } else { resume_unwind(why) }
        })
    })?;
    let (module, probes) = lowered_for(device, &block, case.megahertz);
    let schedule = scheduled_for(device, &block, case.megahertz);
    Some(Built { block, inputs, outputs, schedule, module, probes })
}

/// All dumps of a case.
pub fn shown(case: &Case) -> String {
    let Ok(Some(built)) = catch_unwind(|| build(case)) else { return "not built\n".to_owned() };
    let modules: String = built.module.hierarchy().iter().map(|module| dump::module(module)).collect();
    dump::block(&built.block) + &dump::schedule(&built.schedule) + &modules
}
