//! The sections of a block become modules of their own, instances in that of the block.
//!
//! A value is where it was made. Its later copies, and what else the lowering adds, are in the section that reads them; where several
//! do, beside the value if its section is one of them, else in the block, as are delay lines from one section to another. Copies of
//! one value stay together. Constants are wherever they are read.

use super::PROBE;
use crate::graph::{Place, Section};
use crate::netlist::module::{Driver, Home, Instance, Module, Signal, SignalId};
use crate::op::Comb;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::rc::Rc;

/// The number of a section; none is the block.
type At = Option<usize>;

/// A module with its sections as instances.
pub(super) fn divided(whole: Module, sections: &[Section]) -> Module {
    if sections.is_empty() {
        return whole;
    }
    let homes = homes(&whole);
    let instances = instances(&whole, &homes);
    let read = readers(&whole, &homes, &instances);
    let mut cut = Cut { whole: &whole, homes, instances, read };
    (0..sections.len()).for_each(|k| cut.keep_vectors_together(Some(k)));
    let made = sections.iter().enumerate().map(|(k, section)| cut.section(k, section));
    // One of which nothing is read has nothing in it.
    cut.block(made.filter(|made| !made.outputs.is_empty()).collect())
}

/// Whether it is a literal where it is read; one that is part of a bundle is not.
fn is_constant(signal: &Signal) -> bool {
    matches!(&signal.driver, Driver::Combinational { op: Comb::Constant(_), .. }) && signal.place.path.is_empty()
}

/// Where each signal is.
fn homes(module: &Module) -> Vec<At> {
    let signals = &module.signals;
    let mut instance_outputs = vec![vec![]; module.instances.len()];
    for (i, signal) in signals.iter().enumerate() {
        if let Driver::Instance { instance, .. } = signal.driver {
            instance_outputs[instance].push(i);
        }
    }
    let mut readers: Vec<Vec<usize>> = vec![vec![]; signals.len()];
    for (i, signal) in signals.iter().enumerate() {
        signal.driver.operands().iter().for_each(|operand| readers[operand.0].push(i));
    }
    for (instance, outputs) in module.instances.iter().zip(&instance_outputs) {
        instance.inputs.iter().for_each(|input| readers[input.0].extend(outputs));
    }
    // Copies of one value together.
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let free = |i: &usize| signals[*i].home == Home::WhereRead && !matches!(signals[*i].driver, Driver::Port);
    (0..signals.len()).filter(free).for_each(|i| groups.entry(&signals[i].place.base).or_default().push(i));
    let fixed = |i: usize| match signals[i].home {
        Home::Section(k) if !matches!(signals[i].driver, Driver::Port) => Some(k),
        _ => None,
    };
    let leaves: BTreeSet<usize> = module.outputs.iter().map(|(_, id)| id.0).collect();
    let mut homes: Vec<Option<At>> = (0..signals.len()).map(|i| (!free(&i)).then(|| fixed(i))).collect();
    // What reads last is settled first; each pass settles a group or more.
    for pass in 0.. {
        assert!(pass <= 2 * groups.len() + 2, "module {}: copies of values have no places", module.name);
        let mut settled = true;
        for members in groups.values() {
            let outside = members.iter().flat_map(|i| &readers[*i]).filter(|reader| !members.contains(reader));
            let leaves = members.iter().any(|i| leaves.contains(i)).then_some(None);
            let read: BTreeSet<At> = outside.filter_map(|reader| homes[*reader]).chain(leaves).collect();
            let operands = members.iter().flat_map(|i| signals[*i].driver.operands());
            let made = operands.filter(|o| !free(&o.0)).filter_map(|o| homes[o.0]).find(|at| at.is_some());
            let home = match read.len() {
                0 => continue,
                1 => read.first().copied().flatten(),
                _ => made.filter(|made| read.contains(made)).flatten(),
            };
            settled &= members.iter().all(|i| homes[*i] == Some(home));
            members.iter().for_each(|i| homes[*i] = Some(home));
        }
        if settled {
            break;
        }
    }
    homes.into_iter().map(Option::flatten).collect()
}

/// Where each instance is.
fn instances(module: &Module, homes: &[At]) -> Vec<At> {
    let mut of = vec![None; module.instances.len()];
    for (signal, home) in module.signals.iter().zip(homes) {
        if let Driver::Instance { instance, .. } = signal.driver {
            of[instance] = *home;
        }
    }
    of
}

/// By signal, from where it is read.
fn readers(module: &Module, homes: &[At], instances: &[At]) -> Vec<BTreeSet<At>> {
    let mut read = vec![BTreeSet::new(); module.signals.len()];
    for (signal, home) in module.signals.iter().zip(homes) {
        signal.driver.operands().iter().for_each(|operand| _ = read[operand.0].insert(*home));
    }
    for (instance, home) in module.instances.iter().zip(instances) {
        instance.inputs.iter().for_each(|input| _ = read[input.0].insert(*home));
    }
    module.outputs.iter().for_each(|(_, id)| _ = read[id.0].insert(None));
    read
}

/// A section, and the signals of the whole at its ports.
struct Made {
    module: Module,
    inputs: Vec<SignalId>,
    outputs: Vec<SignalId>,
}

struct Cut<'a> {
    whole: &'a Module,
    homes: Vec<At>,
    instances: Vec<At>,
    read: Vec<BTreeSet<At>>,
}

impl Cut<'_> {
    fn signals(&self, which: impl Fn(SignalId) -> bool) -> Vec<SignalId> {
        (0..self.whole.signals.len()).map(SignalId).filter(|id| which(*id)).collect()
    }

    /// Whether a signal is driven in a place.
    fn made(&self, id: SignalId, at: At) -> bool {
        let constant = is_constant(self.whole.signal(id));
        if constant { self.read[id.0].contains(&at) } else { self.homes[id.0] == at }
    }

    /// A place that reads a flag of a vector made elsewhere reads all of that vector that are made elsewhere.
    fn keep_vectors_together(&mut self, at: At) {
        let vector = |id: SignalId| self.whole.signal(id).vector().filter(|_| !self.made(id, at));
        let enter = self.signals(|id| self.read[id.0].contains(&at));
        let vectors: HashSet<_> = enter.into_iter().filter_map(vector).collect();
        let more = self.signals(|id| vector(id).is_some_and(|of| vectors.contains(&of)));
        more.into_iter().for_each(|id| _ = self.read[id.0].insert(at));
    }

    /// What a signal is called where it leaves a section: after an output of the block, if it leads there and the block has no other
    /// signal of that name.
    fn leaving(&self, id: SignalId) -> &Place {
        let here =
            |i: usize| i != id.0 && (self.homes[i].is_none() || self.read[i].iter().any(|at| *at != self.homes[i]));
        let taken = |place: &Place| self.whole.signals.iter().enumerate().any(|(i, s)| here(i) && s.place == *place);
        // A probe takes no name.
        let named = |place: &Place| !place.base.starts_with(PROBE) && !taken(place);
        let mut outputs = self.whole.outputs.iter().filter(|(place, output)| *output == id && named(place));
        outputs.next().map_or(&self.whole.signal(id).place, |(place, _)| place)
    }

    /// What is in a place, with these signals from elsewhere: a module of that name and header, and where each signal of the whole is in
    /// it.
    fn part(
        &self,
        at: At,
        from_elsewhere: &[SignalId],
        (name, doc): (&str, &[String]),
        more: String,
    ) -> (Module, HashMap<SignalId, SignalId>) {
        let mut part = Module::new(name, [doc, &[more]].concat());
        let kept = self.signals(|id| self.made(id, at) || from_elsewhere.contains(&id));
        let moved: HashMap<SignalId, SignalId> =
            kept.iter().enumerate().map(|(new, id)| (*id, SignalId(new))).collect();
        let here: Vec<usize> = (0..self.instances.len()).filter(|i| self.instances[*i] == at).collect();
        for id in kept {
            let mut signal = self.whole.signal(id).clone();
            if !self.made(id, at) {
                signal.driver = Driver::Port;
            }
            signal.driver.operands_mut().into_iter().for_each(|id| *id = moved[id]);
            if let Driver::Instance { instance, .. } = &mut signal.driver {
                *instance = here.iter().position(|i| i == instance).expect("an instance is where its outputs are");
            }
            part.signals.push(signal);
        }
        for i in here {
            let mut instance = self.whole.instances[i].clone();
            instance.inputs.iter_mut().for_each(|id| *id = moved[id]);
            part.instances.push(instance);
        }
        (part, moved)
    }

    /// A section: what it reads from elsewhere are its inputs, what is read elsewhere its outputs.
    fn section(&self, k: usize, section: &Section) -> Made {
        let at = Some(k);
        let inputs = self.signals(|id| !self.made(id, at) && self.read[id.0].contains(&at));
        let outputs = self.signals(|id| {
            let leaves = self.read[id.0].iter().any(|reader| *reader != at);
            leaves && self.made(id, at) && !is_constant(self.whole.signal(id))
        });
        let clocks = format!("Clocks are those of {}.", self.whole.name);
        let (mut module, moved) = self.part(at, &inputs, (&section.name, &section.doc), clocks);
        module.section = true;
        module.inputs = inputs.iter().map(|id| moved[id]).collect();
        module.outputs = outputs.iter().map(|id| (self.leaving(*id).clone(), moved[id])).collect();
        Made { module, inputs, outputs }
    }

    /// The block with its sections as instances behind its own.
    fn block(&self, sections: Vec<Made>) -> Module {
        let from: Vec<SignalId> = sections.iter().flat_map(|made| [&made.inputs[..], &made.outputs].concat()).collect();
        let more = "Each section is an entity; delays from one to another are here.".to_owned();
        let (mut block, moved) = self.part(None, &from, (&self.whole.name, &self.whole.doc), more);
        block.latency = self.whole.latency;
        for made in sections {
            let instance = block.instances.len();
            for (port, id) in made.outputs.iter().enumerate() {
                let signal = &mut block.signals[moved[id].0];
                (signal.place, signal.driver) = (self.leaving(*id).clone(), Driver::Instance { instance, port });
            }
            let place = Place::new(format!("{}_section", made.module.name));
            let inputs = made.inputs.iter().map(|id| moved[id]).collect();
            block.instances.push(Instance { place, module: Rc::new(made.module), inputs });
        }
        block.inputs = self.whole.inputs.iter().map(|id| moved[id]).collect();
        block.outputs = self.whole.outputs.iter().map(|(place, id)| (place.clone(), moved[id])).collect();
        block
    }
}
