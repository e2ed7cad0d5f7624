//! Bundles as types of VHDL: which signals of a module are one object, and what its type is called.

use crate::expression::{Index, Name, Sub};
use crate::graph::{Place, Step, append_step};
use crate::netlist::{Module, SignalId};
use crate::op::Type;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::rc::Rc;

/// What an object is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Shape {
    /// `std_logic`.
    Flag,
    /// A signed or unsigned number of so many bits.
    Number(bool, u32),
    /// A record: its kind, its fields.
    Record(&'static str, Vec<(&'static str, Shape)>),
    /// An array of equal elements; a vector has the components x, y, z.
    Array {
        /// Whether the elements are components.
        vector: bool,
        /// Number of the first element: those of a part of a bundle have the numbers that they have in the bundle.
        first: usize,
        /// Number of elements.
        size: usize,
        /// What each is.
        of: Box<Shape>,
    },
}

impl Shape {
    pub fn of(ty: Type) -> Self {
        if ty.is_flag() { Self::Flag } else { Self::Number(ty.signed, ty.bits) }
    }

    /// Whether it is printed as a `std_logic_vector`.
    pub fn is_flags(&self) -> bool {
        matches!(self, Self::Array { of, .. } if **of == Self::Flag)
    }

    /// The part that steps lead to.
    pub fn part(&self, subs: &[Sub]) -> Option<&Self> {
        let Some((first, rest)) = subs.split_first() else { return Some(self) };
        match (self, first) {
            (Self::Record(_, fields), Sub::Field(name)) => fields.iter().find(|f| f.0 == *name)?.1.part(rest),
            (Self::Array { of, .. }, Sub::Index(_)) => of.part(rest),
            _ => None,
        }
    }

    /// What its type is called, without the ending; widths of all fields where `exact`.
    fn stem(&self, exact: bool) -> String {
        match self {
            Self::Flag => "flag".to_owned(),
            Self::Number(signed, bits) => format!("{}_{bits}", if *signed { "signed" } else { "unsigned" }),
            Self::Record(kind, fields) => {
                let mut widths: Vec<String> = fields.iter().filter_map(|f| f.1.width()).collect();
                if !exact {
                    widths.truncate(1);
                }
                widths.iter().fold((*kind).to_owned(), |stem, bits| format!("{stem}_{bits}"))
            }
            Self::Array { vector: true, of, .. } => format!("{}_vector", of.stem(exact)),
            Self::Array { first: 0, size, of, .. } => format!("{}_x{size}", of.stem(exact)),
            Self::Array { first, size, of, .. } => format!("{}_{first}_to_{}", of.stem(exact), first + size - 1),
        }
    }

    /// The width of a number, marked where it has no sign.
    fn width(&self) -> Option<String> {
        match self {
            Self::Number(signed, bits) => Some(format!("{}{bits}", if *signed { "" } else { "u" })),
            _ => None,
        }
    }

    /// The parts that have type declarations of their own, inner ones first, and itself.
    fn declared(&self, all: &mut Vec<Self>) {
        match self {
            Self::Record(_, fields) => fields.iter().for_each(|f| f.1.declared(all)),
            Self::Array { of, .. } => of.declared(all),
            _ => return,
        }
        if !self.is_flags() && !all.contains(self) {
            all.push(self.clone());
        }
    }
}

/// The types of a design.
#[derive(Default)]
pub(super) struct Types {
    /// Those that are declared, inner ones first.
    all: Vec<Shape>,
    /// Short stems that several of them have.
    shared: BTreeSet<String>,
}

impl Types {
    /// Includes the types of an object.
    pub fn include(&mut self, shape: &Shape) {
        shape.declared(&mut self.all);
    }

    /// Brings the declarations into an order that does not depend on where the types are used, and finds names for them: after the
    /// last type.
    pub fn sort(&mut self) {
        fn depth(shape: &Shape) -> usize {
            match shape {
                Shape::Flag | Shape::Number(..) => 0,
                Shape::Record(_, fields) => 1 + fields.iter().map(|f| depth(&f.1)).max().unwrap_or(0),
                Shape::Array { of, .. } => 1 + depth(of),
            }
        }
        self.all.sort_by_key(|shape| (depth(shape), shape.clone()));
        let mut known = BTreeSet::new();
        let stems = self.all.iter().map(|shape| shape.stem(false));
        self.shared = stems.filter(|stem| !known.insert(stem.clone())).collect();
    }

    fn stem(&self, shape: &Shape) -> String {
        let short = shape.stem(false);
        if self.shared.contains(&short) { shape.stem(true) } else { short }
    }

    /// The names of the types and of their constants.
    pub fn names(&self) -> Vec<String> {
        self.all.iter().flat_map(|shape| [self.name(shape), self.zero(shape)]).collect()
    }

    /// The type's name, or its text where it needs none.
    pub fn name(&self, shape: &Shape) -> String {
        match shape {
            Shape::Flag => "std_logic".to_owned(),
            Shape::Number(signed, bits) => {
                format!("{}({} downto 0)", if *signed { "signed" } else { "unsigned" }, bits - 1)
            }
            Shape::Array { first, size, .. } if shape.is_flags() => {
                format!("std_logic_vector({} downto {first})", first + size - 1)
            }
            _ => format!("{}_t", self.stem(shape)),
        }
    }

    /// The value with all bits zero.
    pub fn zero(&self, shape: &Shape) -> String {
        match shape {
            Shape::Flag => "'0'".to_owned(),
            Shape::Number(..) => "(others => '0')".to_owned(),
            _ if shape.is_flags() => "(others => '0')".to_owned(),
            _ => format!("zero_{}", self.stem(shape)),
        }
    }

    /// The declarations of the package: types, and the constants of zero that these texts, or others of them, use.
    pub fn declarations<'t>(&self, texts: impl Iterator<Item = &'t str>) -> Vec<String> {
        let words = |text: &'t str| text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let mut used: HashSet<String> =
            texts.flat_map(words).filter(|word| word.starts_with("zero_")).map(str::to_owned).collect();
        for shape in self.all.iter().rev().filter(|shape| !shape.is_flags()) {
            if used.contains(&self.zero(shape)) {
                match shape {
                    Shape::Record(_, fields) => used.extend(fields.iter().map(|field| self.zero(&field.1))),
                    Shape::Array { of, .. } => _ = used.insert(self.zero(of)),
                    Shape::Flag | Shape::Number(..) => {}
                }
            }
        }
        let mut lines = vec![];
        for shape in &self.all {
            let name = self.name(shape);
            let zero = match shape {
                Shape::Record(_, fields) => {
                    lines.push(format!("type {name} is record"));
                    lines.extend(fields.iter().map(|(field, shape)| format!("  {field} : {};", self.name(shape))));
                    lines.push(format!("end record {name};"));
                    let zeros: Vec<String> = fields.iter().map(|f| format!("{} => {}", f.0, self.zero(&f.1))).collect();
                    format!("({})", zeros.join(", "))
                }
                Shape::Array { first, size, of, .. } => {
                    let last = first + size - 1;
                    lines.push(format!("type {name} is array ({first} to {last}) of {};", self.name(of)));
                    format!("(others => {})", self.zero(of))
                }
                _ => continue,
            };
            if used.contains(&self.zero(shape)) {
                lines.push(format!("constant {} : {name} := {zero};", self.zero(shape)));
            }
        }
        lines
    }
}

/// The fields of every kind of record, in order, as far as signals of the design have them.
#[derive(Default)]
pub(super) struct Records(BTreeMap<&'static str, BTreeMap<usize, &'static str>>);

impl Records {
    /// Collects the records of a design.
    pub fn of(modules: &[Rc<Module>]) -> Self {
        let mut records = Self::default();
        for module in modules {
            let places = module.signals.iter().map(|s| &s.place).chain(module.outputs.iter().map(|o| &o.0));
            for step in places.flat_map(|p| &p.path) {
                if let Step::Field(kind, place, field) = step {
                    records.0.entry(kind).or_default().insert(*place, field);
                }
            }
        }
        records
    }

    /// The shape of signals that are one object, with the steps to each of them.
    fn shape(&self, members: &[Member]) -> Option<(Shape, Vec<Vec<Sub>>)> {
        let Some(first) = members[0].path.first() else {
            return (members.len() == 1).then(|| (Shape::of(members[0].ty), vec![vec![]]));
        };
        if !members.iter().all(|m| m.path.first().is_some_and(|s| s.alike(*first))) {
            return None;
        }
        let parts = split(members);
        let mut shapes = vec![];
        let mut subs = vec![vec![]; members.len()];
        // A record of one field is its field.
        let plain = matches!(first, Step::Field(kind, ..) if self.0[kind].len() == 1);
        for (step, part) in &parts {
            let (shape, within) = self.shape(&part.iter().map(|(_, m)| m.clone()).collect::<Vec<_>>())?;
            shapes.push(shape);
            for ((i, _), mut within) in part.iter().zip(within) {
                match step {
                    _ if plain => {}
                    Step::Index(k) | Step::Component(k) => within.insert(0, Sub::Index(Index::At(*k))),
                    Step::Field(_, _, field) | Step::Beside(field) => within.insert(0, Sub::Field(field)),
                }
                subs[*i] = within;
            }
        }
        let shape = match first {
            Step::Field(..) if plain => shapes.remove(0),
            Step::Field(kind, ..) => {
                let fields: Vec<&str> = self.0[kind].values().copied().collect();
                let given: Vec<&str> = parts.iter().map(|(step, _)| field_of(*step)).collect();
                // Flags of the fields of a record are no such record.
                if given != fields || shapes.iter().all(|s| *s == Shape::Flag) {
                    return None;
                }
                Shape::Record(kind, fields.into_iter().zip(shapes).collect())
            }
            Step::Index(_) | Step::Component(_) => {
                let number = |step: &Step| match step {
                    Step::Index(k) | Step::Component(k) => *k,
                    Step::Field(..) | Step::Beside(_) => usize::MAX,
                };
                let vector = matches!(first, Step::Component(_));
                let first = number(&parts[0].0);
                // One of several elements is no array.
                let whole = (vector || parts.len() > 1)
                    && parts.iter().enumerate().all(|(k, (step, _))| number(step) == first + k);
                if !whole || (vector && parts.len() != 3) || shapes.iter().any(|s| *s != shapes[0]) {
                    return None;
                }
                Shape::Array { vector, first, size: parts.len(), of: Box::new(shapes.remove(0)) }
            }
            // Companions are objects of their own.
            Step::Beside(_) => return None,
        };
        Some((shape, subs))
    }
}

fn field_of(step: Step) -> &'static str {
    match step {
        Step::Field(_, _, field) => field,
        _ => "",
    }
}

/// A signal that is to become part of an object.
#[derive(Clone)]
pub(super) struct Member {
    pub path: Vec<Step>,
    pub ty: Type,
    pub id: SignalId,
    pub process: Option<Process>,
}

/// The process that drives a signal; none for a concurrent statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Process {
    /// Registers of a clock of the pair's slot.
    Clock(Option<i32>),
    /// Registers that are loaded once per pair.
    Captures,
    /// Delay lines.
    Delays,
    /// Registers with a reset.
    State,
}

/// Members by their first step, which is taken away, with their places before.
fn split(members: &[Member]) -> Vec<(Step, Vec<(usize, Member)>)> {
    let mut parts: Vec<(Step, Vec<(usize, Member)>)> = vec![];
    for (i, member) in members.iter().enumerate() {
        let Some((first, rest)) = member.path.split_first() else { continue };
        let part = Member { path: rest.to_vec(), ..member.clone() };
        match parts.iter_mut().find(|p| p.0 == *first) {
            Some((_, members)) => members.push((i, part)),
            None => parts.push((*first, vec![(i, part)])),
        }
    }
    parts.sort_by_key(|(step, _)| match step {
        Step::Index(k) | Step::Component(k) => *k,
        Step::Field(_, place, _) => *place,
        Step::Beside(_) => 0,
    });
    parts
}

/// An object of a module.
pub(super) struct Object {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// The signals it is made of, with the steps to each.
    pub members: Vec<(SignalId, Vec<Sub>)>,
}

impl Object {
    /// Name of a part.
    pub fn part(&self, subs: &[Sub]) -> Name {
        Name { base: self.name.clone(), subs: subs.to_vec() }
    }
}

/// The objects that signals at places become: whole bundles where all of a bundle is there, else their parts.
/// What one process drives is no object together with anything else: in its loops it would drive all of it.
pub(super) fn objects(
    records: &Records,
    places: impl Iterator<Item = (Place, Type, SignalId)>,
    process: &dyn Fn(SignalId) -> Option<Process>,
) -> Vec<Object> {
    let places: Vec<(Place, Type, SignalId)> = places.collect();
    let mut greatest: BTreeMap<String, usize> = BTreeMap::new();
    for (place, ..) in &places {
        if let Some(Step::Index(i)) = place.path.first() {
            let index = greatest.entry(place.base.clone()).or_default();
            *index = (*index).max(*i);
        }
    }
    let mut bundles: Vec<((String, String), Vec<Member>)> = vec![];
    for (mut place, ty, id) in places {
        // What is there once is no array.
        if greatest.get(&place.base) == Some(&0) && matches!(place.path.first(), Some(Step::Index(_))) {
            place.path.remove(0);
        }
        let key = (place.base.clone(), place.suffix);
        let member = Member { path: place.path, ty, id, process: process(id) };
        match bundles.iter_mut().find(|b| b.0 == key) {
            Some((_, members)) => members.push(member),
            None => bundles.push((key, vec![member])),
        }
    }
    let each = bundles.into_iter();
    each.flat_map(|((base, suffix), members)| collect(records, &base, &suffix, &members)).collect()
}

/// The fewest objects that are all of the members.
fn collect(records: &Records, base: &str, suffix: &str, members: &[Member]) -> Vec<Object> {
    if let Some((shape, subs)) = together(records, members) {
        let members = members.iter().map(|m| m.id).zip(subs).collect();
        return vec![Object { name: format!("{base}{suffix}"), shape, members }];
    }
    // Apart by one of the steps, which goes into the name, but for elements in a row: by that which leaves the fewest.
    let longest = members.iter().map(|m| m.path.len()).max().unwrap_or(0);
    let apart = (0..longest).map(|at| {
        let rows = rows(records, members, at);
        let most = rows.iter().map(|row| row.0.len()).max().unwrap_or(0);
        // The name of the bundle, which may be that of a member.
        let mut plain = rows.iter().all(|row| row.0[0].is_some());
        let of_row = |(steps, mut members): (Vec<Option<Step>>, Vec<Member>)| {
            let mut base = base.to_owned();
            match steps[..] {
                [step] => {
                    step.iter().for_each(|_| members.iter_mut().for_each(|member| _ = member.path.remove(at)));
                    step.into_iter().for_each(|step| append_step(&mut base, step));
                }
                // The longest row is called after the bundle.
                _ if plain && steps.len() == most => plain = false,
                [Some(Step::Index(first)), .., Some(Step::Index(last))] => base += &format!("_{first}_to_{last}"),
                _ => unreachable!("a row of elements"),
            }
            collect(records, &base, suffix, &members)
        };
        rows.into_iter().flat_map(of_row).collect::<Vec<Object>>()
    });
    apart.min_by_key(Vec::len).unwrap_or_default()
}

/// The shape of members that are one object, with the steps to each of them.
fn together(records: &Records, members: &[Member]) -> Option<(Shape, Vec<Vec<Sub>>)> {
    let alike = members.iter().all(|m| m.process == members[0].process);
    alike.then(|| records.shape(members)).flatten()
}

/// Members by one of their steps, elements in a row together where that makes one object.
fn rows(records: &Records, members: &[Member], at: usize) -> Vec<(Vec<Option<Step>>, Vec<Member>)> {
    let mut parts: Vec<(Option<Step>, Vec<Member>)> = vec![];
    for member in members {
        let step = member.path.get(at).copied();
        match parts.iter_mut().find(|p| p.0 == step) {
            Some((_, members)) => members.push(member.clone()),
            None => parts.push((step, vec![member.clone()])),
        }
    }
    if parts.iter().all(|(step, _)| matches!(step, Some(Step::Index(_)))) {
        parts.sort_by_key(|part| part.0);
    }
    let mut rows: Vec<(Vec<Option<Step>>, Vec<Member>)> = vec![];
    for (step, members) in parts {
        let (Some((steps, row)), Some(Step::Index(k))) = (rows.last_mut(), step) else {
            rows.push((vec![step], members));
            continue;
        };
        let follows = k > 0 && steps.last() == Some(&Some(Step::Index(k - 1)));
        let both = [&row[..], &members].concat();
        if follows && together(records, &both).is_some() {
            *row = both;
            steps.push(step);
        } else {
            rows.push((vec![step], members));
        }
    }
    rows
}
