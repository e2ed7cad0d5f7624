//! The volume unit: the data path with registers for an expansion in front of it, and the handshakes.

use super::volume_path::{self, PREFIX};
use crate::format::EngineFormat;
use crate::params::EngineParams;
use crate::words::BlockLayout;
use efsat_hardware::device::Device;
use efsat_hardware::graph::{Block, Place, Step};
use efsat_hardware::netlist::lower::{HOLDS, Lowering, PHASE};
use efsat_hardware::netlist::{Control, Module, Wire};
use efsat_hardware::op::{Concatenate, Type};
use efsat_hardware::schedule::{Schedule, Scheduler};
use efsat_unit::design::top::{Design, DesignError};
use efsat_unit::params::Params;
use efsat_unit::parts::{Slots, output};
use std::rc::Rc;

/// A volume unit: proven graph, schedule and modules.
pub struct VolumeDesign {
    /// Formats.
    pub format: EngineFormat,
    /// Target part.
    pub device: &'static Device,
    /// Data path, with the proven ranges of all nodes.
    pub path: Rc<Block>,
    /// Schedule of the data path.
    pub schedule: Rc<Schedule>,
    /// The unit without the words around it: in the netlist with a port for each number.
    pub stage: Rc<Module>,
    /// Clocks from the acceptance of an expansion to its answer.
    pub latency: usize,
    /// Clocks between expansions.
    pub interval: usize,
}

/// A port of the volume unit, and the numbers in it: their ports of the stage.
pub struct WordPort {
    /// Name.
    pub name: &'static str,
    /// Bits.
    pub bits: u32,
    /// Port of the stage, its lowest bit in the word, and its bits.
    pub numbers: Vec<(String, u32, u32)>,
}

impl WordPort {
    /// Whether it belongs to the query.
    pub fn of_query(&self) -> bool {
        self.name.starts_with("query")
    }
}

impl VolumeDesign {
    /// Builds, proves, schedules and lowers the volume unit of an engine; `unit` is what stands behind it.
    ///
    /// # Errors
    /// Parameters out of range, or an unknown device.
    pub fn new(engine: &EngineParams, unit: &Params) -> Result<Self, DesignError> {
        let format = engine.format(unit)?;
        let device = Design::check(unit)?;
        let interval = engine.expansion_clocks as usize;
        let path = volume_path::unit(&format, interval);
        let mut scheduler = Scheduler::new(device, unit.frequency);
        let schedule = scheduler.schedule(&path);
        let (module, _) = Lowering::new(&mut scheduler, device).lower(&path, false);
        let stage = stage(&module, schedule.latency as usize, interval);
        // A clock for the registers in front, and one for those of the answer.
        let latency = schedule.latency as usize + 2;
        assert!(latency > 2, "an answer before what its pairs of children are is listed");
        Ok(Self { format, device, path, schedule, stage, latency, interval })
    }

    /// The clock in MHz that the schedule reaches, and the node that ends its longest path.
    pub fn clock(&self) -> (f64, &str) {
        let (ns, end) = &self.schedule.critical;
        (self.device.megahertz(*ns), end)
    }

    /// The words of the query and of the blocks, as they come from the host and from memory.
    pub fn words(&self) -> Vec<WordPort> {
        let format = &self.format;
        let (block, widths) = (format.block(), format.widths());
        let [origin, shift] = [widths.origin.bits(), widths.translation.bits()];
        let vector = |name: &str, path: &[Step], bits: u32, at: u32| -> Vec<(String, u32, u32)> {
            let port = |c: usize| Place::at(name, &[path, &[Step::Component(c)]].concat()).to_string();
            (0..3).map(|c| (port(c), at + bits * c as u32, bits)).collect()
        };
        let pose =
            (0..3).flat_map(|i| vector("query_pose", &[Step::Index(i)], origin, 3 * origin * i as u32)).collect();
        let row_bits = format.rest_at() + format.rest_bits();
        let row = |i: u32| {
            let at = row_bits * i;
            let field = |name: &'static str, slot: Option<u32>| {
                let steps = [Step::Index(i as usize), Step::Field("", 0, name)];
                let slot = slot.map(|slot| Step::Index(slot as usize));
                Place::at("query_row", &steps.into_iter().chain(slot).collect::<Vec<_>>()).to_string()
            };
            let slot = |s: u32| {
                let choice = at + format.choice_at(s);
                [
                    (field("choice", Some(s)), choice, format.choice_bits()),
                    (field("factor", Some(s)), choice + format.choice_bits(), format.factor_bits),
                ]
            };
            let rest = (field("rest", None), at + format.rest_at(), format.rest_bits());
            (0..3).flat_map(slot).chain([rest]).collect::<Vec<_>>()
        };
        let block_of = |name: &'static str, of: &str| {
            let mut numbers = vector(&format!("{of}_origin"), &[], origin, block.origin_at);
            numbers.push((format!("{of}_exponent"), block.exponent_at, BlockLayout::EXPONENT_BITS));
            for (child, h) in (0..2).flat_map(|child| (0..format.k()).map(move |h| (child, h))) {
                let steps = [child, h].map(|i| Step::Index(i as usize));
                let port = Place::at(format!("{of}_code"), &steps).to_string();
                numbers.push((port, block.code_at(child, h), block.code_bits));
            }
            WordPort { name, bits: 8 * block.stride, numbers }
        };
        let take = |name: &'static str, of: &str| WordPort {
            name,
            bits: 2,
            numbers: (0..2).map(|child| (format!("{of}_take{child}"), child, 1)).collect(),
        };
        let errors = format.shift_error_bits();
        vec![
            WordPort { name: "query_pose", bits: 9 * origin, numbers: pose },
            WordPort { name: "query_shift", bits: 3 * shift, numbers: vector("query_shift", &[], shift, 0) },
            WordPort { name: "query_errors", bits: 3 * errors, numbers: vector("query_error", &[], errors, 0) },
            WordPort {
                name: "query_rows",
                bits: format.rows() * row_bits,
                numbers: (0..format.rows()).flat_map(row).collect(),
            },
            block_of("in_block_a", "a"),
            block_of("in_block_b", "b"),
            take("in_take_a", "a"),
            take("in_take_b", "b"),
        ]
    }
}

/// The data path between registers, with a port for each number.
fn stage(path: &Rc<Module>, latency: usize, interval: usize) -> Rc<Module> {
    let doc = [
        "Registers for the expansion of the running slot, the data path, and which slots in flight hold an expansion. An",
        "expansion is accepted in the last phase of a slot; without one the last one stays.",
    ];
    let m = Control::new(&format!("{PREFIX}stage"), doc.map(str::to_owned).to_vec());
    let [reset, in_valid] = ["reset", "in_valid"].map(|name| m.input(name, Type::FLAG));
    let running = m.register("running", Type::FLAG);
    let one = m.constant(1, Type::FLAG);
    running.comment("clear in reset and in the first clock after").loads(one, None, Some((reset, 0)));
    let slots = Slots::new(&m, reset, interval);
    let in_ready = slots.last.map_or(running, |last| running & last);
    let in_ready = in_ready.named("accepts");
    let accept = (in_valid & in_ready).named("accept");
    in_ready.output("in_ready");
    let holds = slots.holds(accept, latency);

    let given = |id: &_| {
        let signal = path.signal(*id);
        let place = signal.place.clone();
        match (place.base.as_str(), &place.path[..]) {
            (PHASE, _) => return slots.phase.expect("the path has phases"),
            (HOLDS, [Step::Index(age)]) => return holds[*age],
            _ => {}
        }
        let port = m.input(place.clone(), signal.ty);
        let held = m.register(Place { base: format!("held_{}", place.base), ..place }, signal.ty);
        held.loads(port, Some(accept), None);
        held
    };
    let given: Vec<Wire> = path.inputs.iter().map(given).collect();
    let results = m.instance("path", path, &given);

    let answers = slots.leaves(&holds, "answer_phase", latency);
    let valid = m.register("valid", Type::FLAG);
    valid.loads(answers.named("answers"), None, Some((reset, 0)));
    valid.output("out_valid");
    let flags = [0, 1, 2, 3].map(|pair| output(path, &results, &format!("survive{pair}")));
    let word = flags[0].apply(Concatenate, &flags[1..]);
    let survive = m.register("survive", word.ty());
    survive.loads(word.named("survive_word"), None, None);
    survive.output("out_survive");
    m.finish()
}
