//! An entity in GHDL, driven clock by clock through two pipes.

use crate::tools::Ghdl;
use efsat_hardware::tools::Tool;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout};

/// Bits of a port in the row of all inputs or all outputs.
#[derive(Clone, Copy)]
struct Place {
    low: usize,
    bits: usize,
}

/// An entity with the clock `clk` that runs. Ports are numbers or rows of 64-bit words, the lowest first.
pub struct Entity {
    simulation: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    places: HashMap<String, Place>,
    /// The lowest bit first.
    inputs: Vec<bool>,
    outputs: Vec<bool>,
    /// Its folder.
    _ghdl: Ghdl,
}

struct Port {
    name: String,
    input: bool,
    /// None for a single bit.
    bits: Option<usize>,
    unsigned: bool,
}

/// The value of a constant of the package in front, or a number.
fn number(text: &str, package: &str) -> usize {
    let declared = || package.split(&format!("constant {text} : natural := ")).nth(1)?.split(';').next();
    declared().unwrap_or(text).parse().unwrap_or_else(|_| panic!("no number: {text}"))
}

/// The ports of the first entity of a text but for `clk`. The highest bit is a number, or a constant less one; a type is one of the
/// library or a subtype of the package.
fn ports(text: &str, package: &str) -> Vec<Port> {
    let declarations = text.split("port (\n").nth(1).and_then(|rest| rest.split("\n  );").next()).expect("ports");
    let code =
        declarations.lines().filter_map(|line| line.split("--").next()?.trim().trim_end_matches(';').split_once(':'));
    let port = |(name, kind): (&str, &str)| {
        let (direction, kind) = kind.trim().split_once(' ').expect("a direction");
        // The type, or what the package says that its name stands for.
        let name_of_type = kind.split_whitespace().next().expect("a type");
        let declared = package.split(&format!("subtype {name_of_type} is ")).nth(1);
        let kind = declared.and_then(|rest| rest.split(';').next()).unwrap_or(kind);
        let range = kind.split_once('(').and_then(|(_, range)| range.split_once(" downto"));
        let bits = range.map(|(high, _)| match high.strip_suffix(" - 1") {
            Some(bits) => number(bits, package),
            None => number(high, package) + 1,
        });
        let unsigned = kind.trim().starts_with("unsigned");
        Port { name: name.trim().to_owned(), input: direction == "in", bits, unsigned }
    };
    code.map(port).filter(|port| port.name != "clk").collect()
}

/// A testbench that reads `e` and inputs, answering with the outputs, or `c`, which is a rising edge.
fn testbench(name: &str, ports: &[Port], places: &HashMap<String, Place>) -> String {
    let count =
        |input: bool| ports.iter().filter(|port| port.input == input).map(|port| port.bits.unwrap_or(1)).sum::<usize>();
    let (mut map, mut signals, mut wires) = (String::new(), String::new(), String::new());
    for port in ports {
        let Place { low, bits } = places[&port.name];
        let row = if port.input { "inputs" } else { "outputs" };
        let (kind, bits) = match port.bits {
            None => ("std_logic".to_owned(), format!("{row}({low})")),
            Some(_) => {
                let kind = if port.unsigned { "unsigned" } else { "std_logic_vector" };
                (format!("{kind}({} downto 0)", bits - 1), format!("{row}({} downto {low})", low + bits - 1))
            }
        };
        let name = &port.name;
        let _ = writeln!(signals, "  signal {name} : {kind};");
        let _ = match (port.input, port.unsigned) {
            (true, true) => writeln!(wires, "  {name} <= unsigned({bits});"),
            (true, false) => writeln!(wires, "  {name} <= {bits};"),
            (false, true) => writeln!(wires, "  {bits} <= std_logic_vector({name});"),
            (false, false) => writeln!(wires, "  {bits} <= {name};"),
        };
        let _ = write!(map, ", {name} => {name}");
    }
    let (inputs, outputs) = (count(true), count(false));
    format!(
        "library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity player is
end entity player;

architecture simulation of player is
  signal clk : std_logic := '0';
  signal inputs : std_logic_vector({} downto 0) := (others => '0');
  signal outputs : std_logic_vector({} downto 0);
{signals}begin
{wires}  dut : entity work.{name} port map (clk => clk{map});

  play : process
    variable l : line;
    variable c : character;
    variable bits_in : bit_vector({} downto 0);
  begin
    while not endfile(input) loop
      readline(input, l);
      read(l, c);
      if c = 'c' then
        clk <= '1';
        wait for 1 ns;
        clk <= '0';
        wait for 1 ns;
      else
        read(l, bits_in);
        inputs <= to_stdlogicvector(bits_in);
        wait for 1 ns;
        write(l, to_bitvector(outputs));
        writeline(output, l);
      end if;
    end loop;
    wait;
  end process play;
end architecture simulation;
",
        inputs - 1,
        outputs - 1,
        inputs - 1
    )
}

impl Entity {
    /// Analyses a text, behind that of the entities in it, and starts it; all inputs are 0.
    pub fn new(ghdl: &'static Tool, name: &str, text: &str, parts: &str) -> Self {
        let ports = ports(text, parts);
        let mut places = HashMap::new();
        let mut ends = [0; 2];
        for port in &ports {
            let end = &mut ends[usize::from(port.input)];
            let bits = port.bits.unwrap_or(1);
            places.insert(port.name.clone(), Place { low: *end, bits });
            *end += bits;
        }
        let ghdl = Ghdl::new(ghdl);
        ghdl.write("entity.vhd", &[parts, text].concat());
        ghdl.write("player.vhd", &testbench(name, &ports, &places));
        ghdl.analyse(&["entity.vhd", "player.vhd"]);
        let mut simulation = ghdl.start("player", &["--ieee-asserts=disable"]);
        let (to, from) = (simulation.stdin.take().unwrap(), BufReader::new(simulation.stdout.take().unwrap()));
        let [outputs, inputs] = ends.map(|end| vec![false; end]);
        Self { simulation, to, from, places, inputs, outputs, _ghdl: ghdl }
    }

    /// Gives an input a number.
    pub fn set(&mut self, port: &str, value: u64) {
        self.set_words(port, &[value]);
    }

    /// Gives an input the low bits of words, and zeros above.
    pub fn set_words(&mut self, port: &str, words: &[u64]) {
        let Place { low, bits } = self.places[port];
        for i in 0..bits {
            self.inputs[low + i] = words.get(i / 64).is_some_and(|word| word >> (i % 64) & 1 == 1);
        }
    }

    /// Whether an input of one bit was set.
    pub fn input(&self, port: &str) -> bool {
        self.inputs[self.places[port].low]
    }

    /// Computes the outputs from inputs and registers.
    pub fn settle(&mut self) {
        let bits: String = self.inputs.iter().rev().map(|&bit| if bit { '1' } else { '0' }).collect();
        self.to.write_all(format!("e{bits}\n").as_bytes()).unwrap();
        let mut line = String::new();
        self.from.read_line(&mut line).unwrap();
        let bits = line.trim_end();
        assert_eq!(bits.len(), self.outputs.len(), "the simulation has ended: {bits}");
        self.outputs = bits.chars().rev().map(|bit| bit == '1').collect();
    }

    /// An output after [`Entity::settle`], its low 64 bits.
    pub fn get(&self, port: &str) -> u64 {
        self.words(port)[0]
    }

    /// Whether an output of one bit is set.
    pub fn is(&self, port: &str) -> bool {
        self.get(port) == 1
    }

    /// All bits of an output.
    pub fn words(&self, port: &str) -> Vec<u64> {
        let Place { low, bits } = self.places[port];
        let word = |chunk: &[bool]| chunk.iter().rev().fold(0, |word, &bit| word << 1 | u64::from(bit));
        self.outputs[low..low + bits].chunks(64).map(word).collect()
    }

    /// A rising edge.
    pub fn clock(&mut self) {
        self.to.write_all(b"c\n").unwrap();
    }

    /// Some clocks in reset.
    pub fn reset(&mut self) {
        self.set("reset", 1);
        (0..3).for_each(|_| self.clocked());
        self.set("reset", 0);
    }

    fn clocked(&mut self) {
        self.settle();
        self.clock();
    }
}

impl Drop for Entity {
    fn drop(&mut self) {
        // It waits for its next line.
        let _ = self.simulation.kill();
        let _ = self.simulation.wait();
    }
}
