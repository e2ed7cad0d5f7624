//! A generated unit under proof: its VHDL, its ports one by one, and single mistakes put into its text.

use super::settings::Setting;
use efsat::design::{Design, Probes};
use efsat::device;
use efsat::graph::{Block, Place};
use efsat::netlist::lower::Lowering;
use efsat::netlist::{Driver, Module, Signal, SignalId};
use efsat::params::Params;
use efsat::schedule::Scheduler;
use efsat::vhdl::{self, generated_instance};
use std::ops::Range;
use std::rc::Rc;

/// Name of the package of types.
const PACKAGE: &str = "efsat_types";

/// Name of the entity around the unit, with a port for each number.
pub const AROUND: &str = "around";

/// A signal of a unit as a claim sees it.
#[derive(Clone, Debug)]
pub struct Wire {
    /// Name in a claim: a port as it would be called in one word, or with the name of an instance in front.
    pub name: String,
    /// Name in the Verilog of the entity around the unit.
    pub path: String,
    /// Bits.
    pub bits: u32,
    /// Whether the top bit is a sign.
    pub signed: bool,
    /// Declared range, where there is one.
    pub range: Option<(i128, i128)>,
    /// If it is an element of an array, which GHDL makes one word: the elements' bits in all, and the bits below it.
    pub element: Option<(u32, u32)>,
}

impl Wire {
    fn new(name: String, path: String, signal: &Signal) -> Self {
        Self { name, path, bits: signal.ty.bits, signed: signal.ty.signed, range: signal.range, element: None }
    }
}

/// A unit under proof.
pub struct Subject {
    /// Name of the entity.
    pub name: String,
    /// File name and text: the package, the entities that the unit instantiates, the unit, the entity around it.
    pub files: Vec<(String, String)>,
    /// Input ports, the clock excepted.
    pub inputs: Vec<Wire>,
    /// Output ports.
    pub outputs: Vec<Wire>,
    /// Whether there is a clock.
    pub clocked: bool,
    /// The ports of instances, and the numbers among the signals.
    inner: Vec<Wire>,
}

impl Subject {
    /// The entity `name` in the hierarchy of a module.
    pub fn new(top: &Rc<Module>, name: &str) -> Self {
        let modules = top.hierarchy();
        let module = modules.iter().find(|m| m.name == name).unwrap_or_else(|| panic!("no entity {name}"));
        let needed: Vec<String> = module.hierarchy().iter().map(|m| m.name.clone()).collect();
        let mut files = vhdl::print(top, "", PACKAGE, &[]).expect("legal names");
        files.retain(|(file, _)| file == PACKAGE || needed.contains(file));
        let mut inner = vec![];
        inside(top, module, &files, "unit", &mut inner);
        files.push((AROUND.to_owned(), around(top, module)));
        let port = |place: &Place, id: SignalId| Wire::new(place.to_string(), place.to_string(), module.signal(id));
        Self {
            name: name.to_owned(),
            files: files.into_iter().map(|(name, text)| (format!("{name}.vhd"), text)).collect(),
            inputs: module.inputs.iter().map(|id| port(&module.signal(*id).place, *id)).collect(),
            outputs: module.outputs.iter().map(|(place, id)| port(place, *id)).collect(),
            clocked: module.clocked(),
            inner,
        }
    }

    /// An entity of a generated design.
    pub fn of_design(setting: &Setting, name: &str) -> Self {
        Self::designed(setting, Probes::None, name)
    }

    /// An entity of a generated design whose inner numbers come out.
    pub fn probed(setting: &Setting, name: &str) -> Self {
        Self::designed(setting, Probes::All, name)
    }

    fn designed(setting: &Setting, probes: Probes, name: &str) -> Self {
        let params = &setting.params;
        let design = Design::new(params, probes).unwrap_or_else(|e| panic!("{params:?}: {e}"));
        Self::new(&design.top, name)
    }

    /// An entity that a unit instantiates, scheduled and printed like those of a design.
    pub fn of_unit(unit: &Rc<Block>, name: &str) -> Self {
        let params = Params::default();
        let device = device::find(&params.device).expect("the default device");
        let mut scheduler = Scheduler::new(device, params.frequency);
        Self::new(&Lowering::new(&mut scheduler, device).lower(unit, false).0, name)
    }

    /// A port of an instance, or a number inside the unit.
    pub fn inner(&self, name: &str) -> &Wire {
        self.inner.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("{} has no inner {name}", self.name))
    }

    /// An input port.
    pub fn input(&self, name: &str) -> &Wire {
        self.inputs.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("{} has no input {name}", self.name))
    }

    /// The files with one mistake: in the unit, or if that has no such statement, in what it instantiates. `None` if
    /// nothing has.
    pub fn mutated(&self, mutant: &Mutant) -> Option<Vec<(String, String)>> {
        mutant.applied(&self.files)
    }
}

/// The ports of instances in a module and the numbers among its signals, those of its sections too.
fn inside(top: &Rc<Module>, module: &Module, files: &[(String, String)], path: &str, inner: &mut Vec<Wire>) {
    let text = &files.iter().find(|(file, _)| *file == module.name).expect("an entity has a file").1;
    for (number, instance) in module.instances.iter().enumerate() {
        let (place, label) = (instance.place.to_string(), label(text, &instance.place));
        if instance.module.section {
            inside(top, &instance.module, files, &format!("{path}.{label}"), inner);
            continue;
        }
        let name = place.strip_suffix("_unit").unwrap_or(&place);
        let [inputs, outputs] = vhdl::ports(top, &instance.module);
        let ports: Vec<(&Place, u32)> = instance
            .module
            .inputs
            .iter()
            .map(|id| instance.module.signal(*id))
            .map(|s| (&s.place, s.ty.bits))
            .collect();
        let wire = |port: &Place, element: &str, signal| {
            let of_instance = format!("{path}.{label}");
            let array = element.split('(').next().expect("a name");
            let of_record = array.contains('.');
            // An array of one element is that element.
            let alone = array == element && !of_record;
            let part = if alone {
                element
            } else if of_record {
                &port.to_string()
            } else {
                array
            };
            let wire = Wire::new(format!("{name}_{port}"), format!("{of_instance}.{part}"), signal);
            // Element 0 is on the left, but on the right of a vector of flags.
            let is_below = |other: &Place| match (signal.ty.is_flag(), port.path.split_last(), other.path.split_last())
            {
                (true, Some((last, rest)), Some((other, of))) => of > rest || of == rest && other < last,
                _ => other.path > port.path,
            };
            let below = |other: &&(&Place, u32)| other.0.base == port.base && is_below(other.0);
            let bits = |of: &dyn Fn(&&(&Place, u32)) -> bool| ports.iter().filter(|x| of(x)).map(|x| x.1).sum();
            let element = (bits(&|other| other.0.base == port.base), bits(&below));
            Wire { element: Some(element).filter(|_| array == part && !alone), ..wire }
        };
        let signals = instance.module.inputs.iter().map(|id| instance.module.signal(*id));
        inner.extend(signals.zip(&inputs).map(|(signal, element)| wire(&signal.place, element, signal)));
        for signal in &module.signals {
            if let Driver::Instance { instance: by, port } = signal.driver
                && by == number
            {
                inner.push(wire(&instance.module.outputs[port].0, &outputs[port], signal));
            }
        }
    }
    // What enters a section is what it is in the block.
    let own = module.signals.iter().filter(|s| s.named && s.place.path.is_empty());
    let own = own.filter(|s| !module.section || !matches!(s.driver, Driver::Port));
    inner.extend(own.map(|s| Wire::new(s.name(), format!("{path}.{}", s.place), s)));
}

/// What GHDL calls an instance, printed apart or in a generate statement.
fn label(text: &str, place: &Place) -> String {
    if text.contains(&format!("  {place} : entity ")) {
        return place.to_string();
    }
    // The outer one of two loops has a label of its own.
    let looped =
        |label: &String| label.split_once("_of_n").is_none_or(|(of, _)| text.contains(&format!("  {of}_of : for ")));
    generated_instance(place).into_iter().rfind(looped).unwrap_or_else(|| place.to_string())
}

/// An entity with a port for each number of a unit, which GHDL connects with the elements of the unit's ports.
fn around(top: &Rc<Module>, module: &Module) -> String {
    let inputs = module.inputs.iter().map(|id| ("in", &module.signal(*id).place, *id));
    let outputs = module.outputs.iter().map(|(place, id)| ("out", place, *id));
    let elements = vhdl::ports(top, module).concat();
    let mut all: Vec<_> = inputs.chain(outputs).zip(elements).collect();
    // The elements of a port must stand beside each other.
    all.sort_by(|x, y| x.1.cmp(&y.1));
    let clock = ("clk : in std_logic".to_owned(), "clk => clk".to_owned());
    let port = |((direction, place, id), element): &((&str, &Place, SignalId), String)| {
        let ty = module.signal(*id).ty;
        let vhdl = match (ty.is_flag(), ty.signed) {
            (true, _) => "std_logic".to_owned(),
            (_, true) => format!("signed({} downto 0)", ty.bits - 1),
            _ => format!("unsigned({} downto 0)", ty.bits - 1),
        };
        (format!("{place} : {direction} {vhdl}"), format!("{element} => {place}"))
    };
    let (ports, map): (Vec<_>, Vec<_>) =
        module.clocked().then_some(clock).into_iter().chain(all.iter().map(port)).unzip();
    format!(
        "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\nuse work.{PACKAGE}.all;\n\n\
         entity {AROUND} is\n  port (\n    {}\n  );\nend entity {AROUND};\n\n\
         architecture rtl of {AROUND} is\nbegin\n  unit : entity work.{}\n    port map (\n      {}\n    );\n\
         end architecture rtl;\n",
        ports.join(";\n    "),
        module.name,
        map.join(",\n      "),
    )
}

/// A mistake in one statement of the generated text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// The arms of a choice are exchanged.
    WrongArm,
    /// The first comparison of the statement holds of equal operands too.
    NotStrict,
    /// The last one does.
    LastNotStrict,
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
    /// The last `or` has become `and`.
    WrongLastGate,
    /// `not` is missing.
    NotMissing,
    /// Every bit is inverted.
    Inverted,
    /// The slice lies one bit too low.
    WrongSlice,
    /// The entry of this number in a table of flags is wrong.
    WrongEntry(usize),
    /// What is chosen for the number 1 is chosen for 2, and the other way round.
    OtherCase,
    /// The elements 0 and 1 are exchanged.
    OtherElement,
    /// An instance is connected with the component after the right one.
    WrongComponent,
}

/// A mistake and the signal that is assigned wrongly, the constant, or the instances.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// What is wrong.
    pub mistake: Mistake,
    /// The signal as it is written; several, where it depends on the parameters which of them there is.
    pub signal: String,
}

impl Mutant {
    /// Files with the mistake in the last one that has such a statement; `None` if no file has.
    pub fn applied(&self, files: &[(String, String)]) -> Option<Vec<(String, String)>> {
        let mut files = files.to_vec();
        let (text, wrong) = files.iter_mut().rev().find_map(|(_, text)| Some((self.apply(text)?, text)))?;
        *wrong = text;
        Some(files)
    }

    /// The text with the mistake; `None` if no assignment of the signal allows it.
    fn apply(&self, text: &str) -> Option<String> {
        let heads = self
            .signal
            .split('|')
            .flat_map(|signal| [format!(" {signal} <="), format!("constant {signal} :"), format!(" {signal} : for")]);
        heads.into_iter().find_map(|head| {
            // After the line's indentation: a statement of a process is indented more.
            let starts_line = |at: &usize| text[..*at].trim_end_matches(' ').ends_with('\n');
            let start = text.match_indices(&head).map(|(at, _)| at).find(starts_line)? + head.len();
            let end = start + text[start..].find(';')?;
            let in_one_line = text[start..end].split_whitespace().map(|word| format!(" {word}")).collect::<String>();
            let wrong = self.mistake.make(&in_one_line)?;
            Some(format!("{}{wrong}{}", &text[..start], &text[end..]))
        })
    }
}

/// Two substrings exchanged; `None` if neither occurs.
fn exchanged(text: &str, a: &str, b: &str) -> Option<String> {
    (text.contains(a) || text.contains(b)).then(|| text.replace(a, "\0").replace(b, a).replace('\0', b))
}

/// The call of a function that begins there: where it is, and its arguments.
fn call(text: &str, start: usize) -> (Range<usize>, Vec<&str>) {
    let (mut depth, mut from, mut arguments) = (0, 0, vec![]);
    for (at, c) in text.char_indices().skip(start) {
        if c == '(' && depth == 0 {
            from = at + 1;
        } else if (c == ',' || c == ')') && depth == 1 {
            arguments.push(text[from..at].trim());
            from = at + 1;
        }
        depth += i32::from(c == '(') - i32::from(c == ')');
        if c == ')' && depth == 0 {
            return (start..at + 1, arguments);
        }
    }
    panic!("no end of the call in {text}")
}

impl Mistake {
    fn make(self, value: &str) -> Option<String> {
        let instead =
            |range: Range<usize>, new: String| format!("{}{new}{}", &value[..range.start], &value[range.end..]);
        match self {
            Self::WrongArm => {
                if let Some((first, rest)) = value.split_once(" when ") {
                    let (condition, second) = rest.split_once(" else")?;
                    return Some(format!("{second} when {condition} else {first}"));
                }
                let (range, arguments) = call(value, value.find("choose(")?);
                Some(instead(range, format!("choose({}, {}, {})", arguments[0], arguments[2], arguments[1])))
            }
            Self::NotStrict | Self::LastNotStrict => {
                let of = if self == Self::NotStrict { value.find("less(") } else { value.rfind("less(") };
                let (range, arguments) = call(value, of?);
                Some(instead(range, format!("(not less({}, {}))", arguments[1], arguments[0])))
            }
            Self::Reversed => {
                let (x, y) = value.split_once(" - ")?;
                Some(format!(" {y} - {x}"))
            }
            Self::WrongSign => exchanged(value, " + ", " - "),
            Self::NoUlp => {
                let start = value.find(" +")?;
                let mut depth = 0;
                let ends = |c: char| {
                    depth += i32::from(c == '(') - i32::from(c == ')');
                    depth < 0 || depth == 0 && c == ','
                };
                let end = value[start..].find(ends).map_or(value.len(), |at| start + at);
                Some(instead(start..end, String::new()))
            }
            Self::OtherBound => exchanged(value, ".lo", ".hi"),
            Self::WrongGate => exchanged(value, " and ", " or "),
            Self::WrongLastGate => {
                let at = value.rfind(" or ")?;
                Some(instead(at..at + 4, " and ".to_owned()))
            }
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
            Self::WrongEntry(number) => {
                let at = value.find('"')? + 1 + number;
                let other = if value[at..].starts_with('0') { "1" } else { "0" };
                Some(instead(at..at + 1, other.to_owned()))
            }
            Self::OtherCase => exchanged(value, " = 1 ", " = 2 "),
            Self::OtherElement => exchanged(value, "(0)", "(1)"),
            Self::WrongComponent if value.contains("(i)") => Some(value.replacen("(i)", "((i + 1) mod 3)", 1)),
            Self::WrongComponent => exchanged(value, "i + 1", "i + 2"),
        }
    }
}
