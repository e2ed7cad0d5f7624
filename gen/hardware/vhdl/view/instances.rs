//! The instances of a module: which of them are alike and become a loop, and what they are connected with.

use super::{View, around, ports};
use crate::expression::{Expression, Name, Sub};
use crate::graph::{Place, Step, append_step};
use crate::netlist::{Driver, Signal, SignalId};
use crate::op::Type;
use crate::vhdl::fold::{self, Statement};
use crate::vhdl::shape::{Object, Records, Shape, objects};
use std::collections::{BTreeMap, HashMap};

impl View<'_> {
    /// The instances, folded. What cannot be connected as a whole goes through objects of its own.
    pub(super) fn find_instances(&mut self, records: &Records) {
        let module = self.module;
        let mut groups: BTreeMap<usize, (String, Vec<usize>)> = BTreeMap::new();
        let mut order: HashMap<String, usize> = HashMap::new();
        for (i, instance) in module.instances.iter().enumerate() {
            let place = label(&instance.place);
            let label = format!("{}{}", place.base, place.suffix);
            let first = *order.entry(label.clone()).or_insert(i);
            groups.entry(first).or_insert((label, vec![])).1.push(i);
        }
        for (base, members) in groups.into_values() {
            let places =
                members.iter().enumerate().map(|(k, i)| (label(&module.instances[*i].place), Type::FLAG, SignalId(k)));
            let (mut folded, mut assignments) = (vec![], vec![]);
            let groups = objects(records, places, &|_| None);
            let alone = groups.len() == 1;
            for group in groups {
                let alike: Vec<(usize, Vec<Sub>)> =
                    group.members.iter().map(|(k, s)| (members[k.0], s.clone())).collect();
                let label = if alike.len() > 1 && alone { &base } else { &group.name };
                let (instances, more, between) = self.alike(records, label, &group.shape, &alike);
                for object in between {
                    self.shapes.insert(object.name.clone(), object.shape.clone());
                    self.between.push(object);
                }
                folded.extend(instances);
                assignments.extend(more);
            }
            if module.instances[members[0]].module.section {
                self.sections.push((folded, assignments));
            } else {
                self.instances.push((self.begins(members[0]), folded, assignments));
            }
        }
    }

    /// Instances that are elements of a bundle, as one statement, and what brings values to and from their ports. Ports
    /// that are not connected alike go through an array of their own.
    fn alike(
        &self,
        records: &Records,
        label: &str,
        shape: &Shape,
        members: &[(usize, Vec<Sub>)],
    ) -> (Vec<Statement>, Vec<Statement>, Vec<Object>) {
        let child = &self.module.instances[members[0].0].module;
        let mut connections: Vec<Vec<(String, Expression)>> = vec![vec![]; members.len()];
        let (mut assignments, mut extra) = (vec![], vec![]);
        if child.clocked() {
            let clk = ("clk".to_owned(), Expression::Name(Name::whole("clk")));
            connections.iter_mut().for_each(|c| c.push(clk.clone()));
        }
        for (input, port) in ports(records, child) {
            let value = |k: usize, subs: &[Sub]| self.at_port(members[k].0, input, &port, subs);
            let whole =
                |k: usize| self.whole(&port.shape, &mut vec![], &|subs| value(k, subs)).filter(|v| self.is_actual(v));
            let wholes: Option<Vec<Expression>> = (0..members.len()).map(whole).collect();
            let fits = |wholes: &Vec<Expression>| members.len() == 1 || self.counts(shape, members, wholes);
            let actuals = wholes.filter(fits).unwrap_or_else(|| {
                let between = Name::whole(format!("{}_{}", label, port.name));
                let array = around(shape, &port.shape);
                let name = |k: usize| Name { base: between.base.clone(), subs: members[k].1.clone() };
                let leaf = |n: &Name| {
                    let k = (0..members.len()).find(|k| n.subs.starts_with(&members[*k].1))?;
                    let value = value(k, &n.subs[members[k].1.len()..])?;
                    Some(if input {
                        Statement::Assign(n.clone(), value)
                    } else {
                        let Expression::Name(target) = value else { return None };
                        Statement::Assign(target, Expression::Name(n.clone()))
                    })
                };
                assignments.extend(fold::fold(self, &array, &between, 0, &leaf));
                extra.push(Object { name: between.base.clone(), shape: array, members: vec![] });
                (0..members.len()).map(|k| Expression::Name(name(k))).collect()
            });
            connections.iter_mut().zip(actuals).for_each(|(c, actual)| c.push((port.name.clone(), actual)));
        }
        let statement = |k: usize| Statement::Instance {
            label: label.to_owned(),
            entity: child.name.clone(),
            connections: connections[k].clone(),
        };
        let leaf = |n: &Name| members.iter().position(|m| m.1 == n.subs).map(statement);
        (fold::fold(self, shape, &Name::whole(label.to_owned()), 0, &leaf), assignments, extra)
    }

    /// Whether values count with the elements that they are for.
    fn counts(&self, shape: &Shape, members: &[(usize, Vec<Sub>)], values: &[Expression]) -> bool {
        let target = |k: usize| Name { base: String::new(), subs: members[k].1.clone() };
        let leaf = |n: &Name| {
            let k = (0..members.len()).find(|k| target(*k).subs == n.subs)?;
            // Instances are never joined, so neither are these.
            let connections = vec![(String::new(), values[k].clone())];
            Some(Statement::Instance { label: String::new(), entity: String::new(), connections })
        };
        fold::fold(self, shape, &Name::whole(""), 0, &leaf).len() == 1
    }

    /// The value at a part of a port of an instance: what goes in, or the signal that comes out.
    fn at_port(&self, instance: usize, input: bool, port: &Object, subs: &[Sub]) -> Option<Expression> {
        let (index, _) = port.members.iter().find(|m| m.1 == subs)?;
        if input {
            return Some(self.value(self.module.instances[instance].inputs[index.0]));
        }
        let driven =
            |s: &Signal| matches!(s.driver, Driver::Instance { instance: i, port } if (i, port) == (instance, index.0));
        self.module.signals.iter().position(driven).map(|i| self.value(SignalId(i)))
    }

    /// The clock in which an instance takes its inputs.
    fn begins(&self, instance: usize) -> Option<i32> {
        let inputs = &self.module.instances[instance].inputs;
        inputs.iter().filter_map(|id| self.module.signal(*id).clock).max()
    }

    /// Whether a value may stand in a port map.
    fn is_actual(&self, value: &Expression) -> bool {
        match value {
            Expression::Name(_) => true,
            Expression::Number(_, ty) => ty.is_flag(),
            _ => false,
        }
    }
}

/// The place of an instance among its like: the fields of a record differ in name.
fn label(place: &Place) -> Place {
    let is_field = |step: &&Step| matches!(step, Step::Field(..));
    let mut base = place.base.clone();
    place.path.iter().filter(is_field).for_each(|step| append_step(&mut base, *step));
    let path = place.path.iter().filter(|step| !is_field(step)).copied().collect();
    Place { base, path, suffix: place.suffix.clone() }
}
