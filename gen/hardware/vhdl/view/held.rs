//! Copies of values that are held: which of them are one array. The copies of one value under one enable, each loaded from the
//! one before, are `x_held`, the first of them element 0; what is held again under another enable is `x_held_2`. Elements of a bundle
//! that are held alike are held together.

use crate::graph::{Place, Step, append_step};
use crate::netlist::{Driver, Module, SignalId};
use crate::op::Type;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Array dimensions that every tool takes.
const DIMENSIONS: usize = 2;

/// A copy: the signal, its place in the bundle and type, and how it is loaded.
#[derive(Clone)]
struct Copy {
    id: SignalId,
    path: Vec<Step>,
    ty: Type,
    from: SignalId,
    enable: SignalId,
    clocks: i32,
}

/// Copies of one value under one enable, each loaded from the one before.
type Strand = Vec<Copy>;

/// The places of copies in arrays. Others keep theirs, as those do that `is_apart` names.
pub(super) fn places(module: &Module, is_apart: &dyn Fn(SignalId) -> bool) -> HashMap<SignalId, Place> {
    let mut bundles: Vec<((&str, &str), Vec<Copy>)> = vec![];
    let mut sizes: HashMap<&str, usize> = HashMap::new();
    for (i, signal) in module.signals.iter().enumerate() {
        let (id, place) = (SignalId(i), &signal.place);
        if let Some(Step::Index(k)) = place.path.first() {
            let size = sizes.entry(&place.base).or_default();
            *size = (*size).max(k + 1);
        }
        let Driver::Register { op: None, args, enable: Some(enable), reset: None } = &signal.driver else { continue };
        let Some((suffix, clocks)) = place.held().filter(|_| !is_apart(id)) else { continue };
        let copy = Copy { id, path: place.path.clone(), ty: signal.ty, from: args[0], enable: *enable, clocks };
        match bundles.iter_mut().find(|b| b.0 == (&place.base, suffix)) {
            Some((_, copies)) => copies.push(copy),
            None => bundles.push(((&place.base, suffix), vec![copy])),
        }
    }
    let mut arrays = Arrays::default();
    for ((base, suffix), mut copies) in bundles {
        // What is there once is no array.
        if sizes.get(base) == Some(&1) {
            copies.iter_mut().for_each(|copy| _ = copy.path.remove(0));
        }
        arrays.bundle(base, suffix, copies);
    }
    arrays.places
}

#[derive(Default)]
struct Arrays {
    places: HashMap<SignalId, Place>,
    /// Names of arrays, by base and suffix.
    taken: HashSet<(String, String)>,
}

impl Arrays {
    fn bundle(&mut self, base: &str, suffix: &str, copies: Vec<Copy>) {
        let chains = groups(strands(&copies, true));
        let apart = groups(strands(&copies, false));
        // In chains, or all that are the first of their value, then all that are the second, and so on: in fewer objects.
        let objects = |groups: &[Vec<Group>]| groups.iter().flatten().map(|group| group.rows.len()).sum::<usize>();
        let chosen = if objects(&chains) <= objects(&apart) { chains } else { apart };
        let mut number = 1;
        for of_ordinal in chosen {
            let arrays: Vec<Group> = of_ordinal.into_iter().filter(|group| group.is_array).collect();
            let held = if number == 1 { "held".to_owned() } else { format!("held_{number}") };
            number += usize::from(!arrays.is_empty());
            arrays.into_iter().for_each(|group| self.array(base, &format!("{suffix}_{held}"), group.rows));
        }
    }

    /// Gives places to strands of equal length, elements in a row together. The longest row is called after the bundle.
    fn array(&mut self, base: &str, suffix: &str, rows: Vec<Vec<Vec<Strand>>>) {
        let most = rows.iter().map(Vec::len).max().unwrap_or(0);
        for row in rows {
            let plain = row.len() == most && !self.taken.contains(&(base.to_owned(), suffix.to_owned()));
            let lead = |element: &[Strand]| element[0][0].path.first().copied();
            let mut name = base.to_owned();
            let mut skip = 0;
            match (&row[..], lead(&row[0]), row.last().and_then(|element| lead(element))) {
                ([_], Some(step @ Step::Index(_)), _) => {
                    append_step(&mut name, step);
                    skip = 1;
                }
                (_, Some(Step::Index(first)), Some(Step::Index(last))) if !plain => {
                    name += &format!("_{first}_to_{last}");
                }
                _ => {}
            }
            self.taken.insert((name.clone(), suffix.to_owned()));
            for strand in row.into_iter().flatten() {
                let several = strand.len() > 1;
                for (i, copy) in strand.into_iter().enumerate() {
                    let path = several.then_some(Step::Index(i)).into_iter().chain(copy.path.into_iter().skip(skip));
                    let place = Place { base: name.clone(), path: path.collect(), suffix: suffix.to_owned() };
                    self.places.insert(copy.id, place);
                }
            }
        }
    }
}

/// When the copies of a strand are loaded: by how many clocks later, and the enable.
type Loads = (Vec<i32>, SignalId);

/// Strands of one ordinal that are loaded alike, by rows of elements.
struct Group {
    rows: Vec<Vec<Vec<Strand>>>,
    /// Whether it is called an array of held copies: others are called after their clocks.
    is_array: bool,
}

/// By ordinal, the first strand of every value, the second of those that have one, and so on: what is loaded alike.
fn groups(values: Vec<Vec<Strand>>) -> Vec<Vec<Group>> {
    let most = values.iter().map(Vec::len).max().unwrap_or(0);
    let of_ordinal = |k: usize| {
        let mut chains: Vec<(Loads, Vec<Strand>)> = vec![];
        let mut single: BTreeMap<i32, Vec<Strand>> = BTreeMap::new();
        for strand in values.iter().filter_map(|strands| strands.get(k).cloned()) {
            let key = (strand.iter().map(|copy| copy.clocks).collect(), strand[0].enable);
            if strand.len() == 1 {
                single.entry(strand[0].clocks).or_default().push(strand);
            } else if let Some((_, chain)) = chains.iter_mut().find(|chain| chain.0 == key) {
                chain.push(strand);
            } else {
                chains.push((key, vec![strand]));
            }
        }
        let chains = chains.into_iter().map(|(_, chain)| Group { rows: rows(chain), is_array: true });
        let mut groups: Vec<Group> = chains.collect();
        // Copies of different clocks are one array where that is fewer objects.
        let mut all: Vec<Strand> = single.values().flatten().cloned().collect();
        all.sort_by(|a, b| a[0].path.cmp(&b[0].path));
        let together = Group { rows: rows(all), is_array: true };
        let apart = single.into_values().map(|strands| Group { rows: rows(strands), is_array: false });
        let apart: Vec<Group> = apart.collect();
        if together.rows.len() < apart.iter().map(|group| group.rows.len()).sum() {
            groups.push(together);
        } else {
            groups.extend(apart);
        }
        groups
    };
    (0..most).map(of_ordinal).collect()
}

/// The strands of each value, by clocks; each copy by itself unless `chained`.
fn strands(copies: &[Copy], chained: bool) -> Vec<Vec<Strand>> {
    let mut values: BTreeMap<Vec<Step>, Vec<Copy>> = BTreeMap::new();
    copies.iter().for_each(|copy| values.entry(copy.path.clone()).or_default().push(copy.clone()));
    let of_value = |mut copies: Vec<Copy>| {
        copies.sort_by_key(|copy| copy.clocks);
        let mut strands: Vec<Strand> = vec![];
        for copy in copies {
            let before = |s: &&mut Strand| s.last().is_some_and(|c| (c.id, c.enable) == (copy.from, copy.enable));
            match strands.iter_mut().find(before).filter(|_| chained) {
                Some(strand) => strand.push(copy),
                None => strands.push(vec![copy]),
            }
        }
        strands
    };
    values.into_values().map(of_value).collect()
}

/// Strands by elements, those of elements in a row together that are alike in what they have below.
fn rows(strands: Vec<Strand>) -> Vec<Vec<Vec<Strand>>> {
    let mut elements: Vec<Vec<Strand>> = vec![];
    for strand in strands {
        let number = |strand: &Strand| strand[0].path.first().copied().filter(|step| matches!(step, Step::Index(_)));
        match elements.last_mut().filter(|element| number(&element[0]) == number(&strand)) {
            Some(element) => element.push(strand),
            None => elements.push(vec![strand]),
        }
    }
    let mut rows: Vec<Vec<Vec<Strand>>> = vec![];
    for element in elements {
        let follows = |row: &&mut Vec<Vec<Strand>>| row.last().is_some_and(|before| continues(before, &element));
        match rows.last_mut().filter(follows) {
            Some(row) => row.push(element),
            None => rows.push(vec![element]),
        }
    }
    rows
}

/// Whether an element follows another and is like it.
fn continues(before: &[Strand], element: &[Strand]) -> bool {
    let below = |element: &[Strand]| -> Vec<(Vec<Step>, Type)> {
        element.iter().map(|strand| (strand[0].path.iter().skip(1).copied().collect(), strand[0].ty)).collect()
    };
    let follows = match (before[0][0].path.first(), element[0][0].path.first()) {
        (Some(Step::Index(a)), Some(Step::Index(b))) => a + 1 == *b,
        _ => false,
    };
    let counted = element[0][0].path.iter().filter(|s| matches!(s, Step::Index(_) | Step::Component(_))).count();
    let dimensions = counted + usize::from(element[0].len() > 1);
    follows && dimensions <= DIMENSIONS && below(before) == below(element)
}
