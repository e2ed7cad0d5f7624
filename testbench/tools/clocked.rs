//! A netlist in the built-in simulator, driven clock by clock by the names of its ports.

use efsat::netlist::Module;
use efsat::netlist::simulate::Simulation;
use std::collections::HashMap;
use std::rc::Rc;

/// A module that runs.
pub struct Clocked {
    simulation: Simulation,
    inputs: HashMap<String, usize>,
    outputs: HashMap<String, usize>,
}

impl Clocked {
    /// After some clocks in reset; all inputs are 0.
    pub fn new(module: &Rc<Module>) -> Self {
        let inputs = module.inputs.iter().enumerate().map(|(i, id)| (module.signal(*id).name(), i)).collect();
        let outputs = module.outputs.iter().enumerate().map(|(i, (name, _))| (name.to_string(), i)).collect();
        let mut clocked = Self { simulation: Simulation::new(module, 1), inputs, outputs };
        clocked.reset(4);
        clocked
    }

    pub fn reset(&mut self, clocks: usize) {
        self.set("reset", 1);
        (0..clocks).for_each(|_| self.clock());
        self.set("reset", 0);
    }

    pub fn has(&self, port: &str) -> bool {
        self.inputs.contains_key(port) || self.outputs.contains_key(port)
    }

    /// Sets an input in the coming clocks.
    pub fn set(&mut self, name: &str, value: i128) {
        self.simulation.set(*self.inputs.get(name).unwrap_or_else(|| panic!("no input {name}")), 0, value);
    }

    pub fn clock(&mut self) {
        self.simulation.run();
    }

    /// The operands of all products in the clock just run.
    pub fn multiplied(&self) -> Vec<i128> {
        self.simulation.multiplied()
    }

    /// An output in the clock just run.
    pub fn get(&self, name: &str) -> i128 {
        self.simulation.output(*self.outputs.get(name).unwrap_or_else(|| panic!("no output {name}")), 0)
    }
}
