//! Untimed evaluation: every node of a graph in every phase, on integers.

use super::flat::{Flat, Step};
use super::{Block, Op, Place, place};
use crate::op::{Comb, ShiftLeft};
use std::rc::Rc;

/// Evaluates a block; made once, used for many pairs.
pub struct Evaluator {
    flat: Flat,
    values: Vec<i128>,
}

impl Evaluator {
    /// Prepares the evaluation of `top`.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let mut evaluator = Evaluator::new(&block);
    /// evaluator.run(&[-5]);
    /// assert_eq!(evaluator.output("y"), 25);
    /// ```
    pub fn new(top: &Rc<Block>) -> Self {
        let flat = Flat::new(top);
        let values = vec![0; flat.nodes.len() * flat.interval];
        Self { flat, values }
    }

    /// The dissolved graph.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let mut evaluator = Evaluator::new(&block);
    /// assert_eq!(evaluator.flat().nodes.len(), 2);
    /// ```
    pub fn flat(&self) -> &Flat {
        &self.flat
    }

    /// Computes every node from the values of the top's inputs, in port order.
    ///
    /// # Panics
    /// If a lemma is violated, see [`Op::Assume`].
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let mut evaluator = Evaluator::new(&block);
    /// evaluator.run(&[7]);
    /// assert_eq!(evaluator.output("y"), 49);
    /// ```
    pub fn run(&mut self, inputs: &[i128]) {
        let interval = self.flat.interval;
        let mut args = Vec::with_capacity(64);
        let mut types = Vec::with_capacity(64);
        for step in &self.flat.steps {
            let node = &self.flat.nodes[step.node];
            let value = match &node.op {
                Op::Input | Op::Steady => {
                    let port = self.flat.inputs.iter().position(|i| *i == step.node).expect("a top input");
                    inputs[port]
                }
                Op::Phase(values) => values[step.phase].unwrap_or(0),
                Op::Capture { .. } | Op::Mux { .. } | Op::Earlier(_) => {
                    let operand = self.flat.operands(*step)[0];
                    self.values[operand.node * interval + operand.phase]
                }
                Op::ScanOr => {
                    let fresh = self.at(node.args[0], step.phase);
                    let first = self.at(node.args[1], step.phase) != 0 || step.phase == 0;
                    fresh | if first { 0 } else { self.at(step.node, step.phase - 1) }
                }
                op => {
                    args.clear();
                    types.clear();
                    for a in &node.args {
                        args.push(self.at(*a, step.phase));
                        types.push(self.flat.nodes[*a].ty);
                    }
                    match op {
                        // What hardware would lose stays, so that a bound on it is checked and not a bound on what is left.
                        Op::Comb(Comb::ShiftLeft(ShiftLeft(bits))) => args[0] << bits,
                        Op::Comb(op) => op.value(&args, &types, node.ty),
                        _ => known(op, &args, step.phase).unwrap_or_else(|why| panic!("{}: {why}", node.path)),
                    }
                }
            };
            self.values[step.node * interval + step.phase] = value;
        }
    }

    /// Value of a flat node in a phase, after [`Evaluator::run`].
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let mut evaluator = Evaluator::new(&block);
    /// evaluator.run(&[7]);
    /// assert_eq!(evaluator.at(evaluator.flat().outputs[0], 0), 49);
    /// ```
    pub fn at(&self, node: usize, phase: usize) -> i128 {
        let Step { node, phase } = Step { node, phase: if self.flat.per_phase(node) { phase } else { 0 } };
        self.values[node * self.flat.interval + phase]
    }

    /// Value of an output of the top (in phase 0 where it is per phase), or of a vector of flags.
    ///
    /// # Panics
    /// If there is no such output.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let mut evaluator = Evaluator::new(&block);
    /// evaluator.run(&[3]);
    /// assert_eq!(evaluator.output("y"), 9);
    /// ```
    pub fn output(&self, name: &str) -> i128 {
        let block = &self.flat.blocks[0];
        let value = |port: usize| self.at(self.flat.outputs[port], 0);
        let flag = |i: usize| block.outputs.iter().position(|(at, _)| *at == Place::at(name, &[place::Step::Index(i)]));
        match flag(0) {
            // A vector of flags, the first in bit 0.
            Some(_) => (0..).map_while(flag).enumerate().map(|(i, port)| value(port) << i).sum(),
            None => value(block.output(name)),
        }
    }
}

/// The value of what is no hardware, its first operand, if what is known of it holds.
fn known(op: &Op, args: &[i128], phase: usize) -> Result<i128, String> {
    let holds = match op {
        Op::Assume((least, most), _, phases) => {
            phases.get(phase) == Some(&false) || (*least..=*most).contains(&args[0])
        }
        Op::Known(fact) => args[0] == fact.value(args),
        _ => true,
    };
    if holds { Ok(args[0]) } else { Err(format!("{op:?} does not hold of {args:?}")) }
}
