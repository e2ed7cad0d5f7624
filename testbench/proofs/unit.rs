//! A generated unit under proof: its VHDL, its ports, and single mistakes put into its text.

use efsat::artefact;
use efsat::design::Design;
use efsat::device;
use efsat::graph::Unit;
use efsat::graph::lower::Lowering;
use efsat::graph::netlist::{Driver, Module, Signal};
use efsat::graph::range::analyse;
use efsat::graph::schedule::Scheduler;
use efsat::params::Params;
use efsat::vhdl;
use std::rc::Rc;

/// A signal of a unit as a claim sees it.
#[derive(Clone, Debug)]
pub struct Wire {
    /// Name in the unit; a signal of an instance has the instance's label in front, with a dot.
    pub path: String,
    /// Bits.
    pub bits: u32,
    /// Whether the top bit is a sign.
    pub signed: bool,
    /// Declared range, where there is one.
    pub range: Option<(i128, i128)>,
}

impl Wire {
    fn new(path: &str, signal: &Signal) -> Self {
        Self { path: path.to_owned(), bits: signal.ty.bits, signed: signal.ty.signed, range: signal.range }
    }

    /// Its name in a claim.
    pub fn name(&self) -> String {
        self.path.replace('.', "_")
    }
}

/// A unit under proof.
pub struct Subject {
    /// Name of the entity.
    pub name: String,
    /// File name and text of the entity and of those that it instantiates, in dependency order.
    pub files: Vec<(String, String)>,
    /// Input ports, the clock excepted.
    pub inputs: Vec<Wire>,
    /// Output ports.
    pub outputs: Vec<Wire>,
    /// Whether there is a clock.
    pub clocked: bool,
    /// All other signals, and the ports of instances.
    signals: Vec<Wire>,
}

impl Subject {
    fn new(module: &Rc<Module>, files: Vec<(String, String)>) -> Self {
        let port = |id| Wire::new(&module.signal(id).name, module.signal(id));
        let outputs = module.outputs.iter().map(|(name, id)| Wire::new(name, module.signal(*id)));
        let own = module.signals.iter().filter(|s| !matches!(s.driver, Driver::Port));
        let mut signals: Vec<Wire> = own.map(|s| Wire::new(&s.name, s)).collect();
        for instance in &module.instances {
            let inner = &instance.module;
            let ports = inner.inputs.iter().map(|id| inner.signal(*id));
            signals.extend(ports.map(|s| Wire::new(&format!("{}.{}", instance.label, s.name), s)));
        }
        Self {
            name: module.name.clone(),
            files,
            inputs: module.inputs.iter().map(|id| port(*id)).collect(),
            outputs: outputs.collect(),
            clocked: module.clocked(),
            signals,
        }
    }

    /// An entity of a generated design.
    pub fn of_design(params: &Params, name: &str) -> Self {
        let design = Design::new(params, false).unwrap_or_else(|e| panic!("{params:?}: {e}"));
        let all = artefact::vhdl_files(&design, &params.command_line()).expect("legal names");
        let modules = design.top.hierarchy();
        let module = modules.iter().find(|m| m.name == name).unwrap_or_else(|| panic!("no entity {name}"));
        let needed: Vec<String> = module.hierarchy().iter().map(|m| format!("{}.vhd", m.name)).collect();
        Self::new(module, all.into_iter().filter(|(file, _)| needed.contains(file)).collect())
    }

    /// A single unit, scheduled and printed like those of a design.
    pub fn of_unit(unit: &Rc<Unit>) -> Self {
        let params = Params::default();
        let device = device::find(&params.device).expect("the default device");
        let ranges = analyse(unit).unwrap_or_else(|e| panic!("{}: {e}", unit.name));
        let mut scheduler = Scheduler::new(device, params.frequency);
        let (module, _) = Lowering::new(&mut scheduler, device, &ranges).lower(unit, false);
        let text = |m: &Rc<Module>| vhdl::entity(m, &[]).expect("legal names").text();
        let files = module.hierarchy().iter().map(|m| (format!("{}.vhd", m.name), text(m))).collect();
        Self::new(&module, files)
    }

    /// An inner signal.
    pub fn signal(&self, path: &str) -> &Wire {
        let found = self.signals.iter().find(|s| s.path == path);
        found.unwrap_or_else(|| panic!("{} has no signal {path}", self.name))
    }

    /// An input port.
    pub fn input(&self, name: &str) -> &Wire {
        self.inputs.iter().find(|s| s.path == name).unwrap_or_else(|| panic!("{} has no input {name}", self.name))
    }

    /// The files with one mistake.
    pub fn mutated(&self, mutant: &Mutant) -> Vec<(String, String)> {
        let mut files = self.files.clone();
        let (_, text) = files.last_mut().expect("an entity has a file");
        *text = mutant.apply(text).unwrap_or_else(|| panic!("{}: nothing to mutate by {mutant:?}", self.name));
        files
    }
}

/// A mistake in one statement of the generated text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// The arms of a choice are exchanged.
    WrongArm,
    /// A difference is one less: the comparison that its sign is holds of equal operands too.
    NotStrict,
    /// `-` has its operands exchanged.
    Reversed,
    /// `+` or `-` has become the other.
    WrongSign,
    /// Only the first operand of a sum is left: no ulp.
    NoUlp,
    /// A lower bound is taken for an upper one and the other way round.
    OtherBound,
    /// `and` has become `or`, or the other way round.
    WrongGate,
    /// `not` is missing.
    NotMissing,
    /// Every bit is inverted.
    Inverted,
    /// The slice lies one bit too low.
    WrongSlice,
}

/// A mistake and the signal that is assigned wrongly.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// What is wrong.
    pub mistake: Mistake,
    /// The signal.
    pub signal: String,
}

impl Mutant {
    /// The text with the mistake; `None` if the signal's assignment does not allow it.
    fn apply(&self, text: &str) -> Option<String> {
        // After the line's indentation: a statement of a process is indented more.
        let head = format!(" {} <=", self.signal);
        let starts_line = |at: &usize| text[..*at].trim_end_matches(' ').ends_with('\n');
        let start = text.match_indices(&head).map(|(at, _)| at).find(starts_line)? + head.len();
        let end = start + text[start..].find(';')?;
        let wrong = self.mistake.make(&text[start..end])?;
        Some(format!("{}{wrong}{}", &text[..start], &text[end..]))
    }
}

/// Two substrings exchanged; `None` if neither occurs.
fn exchanged(text: &str, a: &str, b: &str) -> Option<String> {
    (text.contains(a) || text.contains(b)).then(|| text.replace(a, "\0").replace(b, a).replace('\0', b))
}

impl Mistake {
    fn make(self, value: &str) -> Option<String> {
        match self {
            Self::WrongArm => {
                let (first, rest) = value.split_once(" when ")?;
                let (condition, second) = rest.split_once(" else")?;
                Some(format!("{second} when {condition} else {first}"))
            }
            Self::NotStrict => value.contains(" - ").then(|| format!("{value} - 1")),
            Self::Reversed => {
                let (x, y) = value.split_once(" - ")?;
                Some(format!(" {y} - {x}"))
            }
            Self::WrongSign => exchanged(value, " + ", " - "),
            Self::NoUlp => Some(value.split_once(" + ")?.0.to_owned()),
            Self::OtherBound => {
                // The name of the type must not become another.
                let value = value.replace("std_logic", "std\u{1}logic");
                Some(exchanged(&value, "_lo", "_hi")?.replace('\u{1}', "_"))
            }
            Self::WrongGate => exchanged(value, " and ", " or "),
            Self::NotMissing => value.contains("not ").then(|| value.replace("not ", "")),
            Self::Inverted => Some(format!(" not ({value})")),
            Self::WrongSlice => {
                let (left, right) = value.split_once(" downto ")?;
                let high = left.rsplit_once('(')?.1;
                let low = right.split_once(')')?.0;
                let lower = |bit: &str| bit.parse::<u32>().ok()?.checked_sub(1);
                let slice = format!("({} downto {})", lower(high)?, lower(low)?);
                Some(value.replace(&format!("({high} downto {low})"), &slice))
            }
        }
    }
}
