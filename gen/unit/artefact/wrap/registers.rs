//! Registers behind AXI4-Lite around a core: the hardware, and the list of registers in VHDL, C, CMSIS-SVD and Markdown.

use crate::artefact::bits::Bits;
use crate::artefact::check::register_script;
use crate::artefact::files::core::FileRow;
use crate::artefact::files::file_lists::FileLists;
use crate::artefact::{FileSet, Prefix, origin};
use crate::words::registers::{self, Access, Behind, PLACES};
use askama::Template;
use std::fmt::Write;

/// A register as files print it.
struct Register {
    name: &'static str,
    upper: String,
    at: String,
    access: &'static str,
    svd_access: &'static str,
    clears: bool,
    read_effect: bool,
    reset: String,
    what: String,
    xml: String,
    fields: Vec<Field>,
}

struct Field {
    name: &'static str,
    upper: String,
    wide: bool,
    low: u32,
    high: u32,
    mask: String,
    what: String,
    xml: String,
}

/// Why an access is refused.
struct Refusal {
    name: &'static str,
    upper: String,
    code: u32,
    bits: String,
    what: &'static str,
}

/// What is behind the registers, and what it needs.
pub struct Shell<'a> {
    /// What it is.
    pub behind: Behind,
    /// Its options, all of them, as a command line: their hash is a register.
    pub options: &'a str,
    /// The prefix of all names.
    pub prefix: &'a Prefix,
    /// Its entity, without a prefix.
    pub core: &'static str,
    /// Bits of an answer, 32 or 64.
    pub answer_bits: u32,
    /// Bits 7..0 of the header of a query, in hexadecimal.
    pub query_kind: String,
    /// Words of a report, and in bits its reason of a soft reset.
    pub report: (usize, String),
    /// Further ports of the core, lines of VHDL.
    pub more_ports: String,
    /// Half a period of the testbench's clock, as VHDL has it.
    pub half_period: String,
    /// Signals and process of the memory in the testbench, if there is one.
    pub memory: [String; 2],
    /// The lines of the testbench's file.
    pub script: String,
}

#[derive(Template)]
#[template(path = "registers/efsat_register_map.vhd", escape = "none")]
struct Map<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    address: Bits,
    registers: &'a [Register],
    refusals: &'a [Refusal],
}

#[derive(Template)]
#[template(path = "registers/efsat_registers.vhd", escape = "none")]
struct Entity<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    core: &'a str,
    is_engine: bool,
    has_caches: bool,
    has_high: bool,
    places: u32,
    place_bits: u32,
    answer: Bits,
    last_place: u32,
    report_words: usize,
    reset_reason: &'a str,
    query_kind: &'a str,
    registers: &'a [Register],
    read: Vec<&'static str>,
    written: Vec<&'static str>,
    constants: &'a [&'static str],
}

#[derive(Template)]
#[template(path = "registers/efsat_shell.vhd", escape = "none")]
struct Around<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    core: &'a str,
    is_engine: bool,
    answer: Bits,
    more_ports: &'a str,
    more_names: Vec<&'a str>,
    lite_ports: Vec<&'static str>,
}

#[derive(Template)]
#[template(path = "registers/efsat_registers.h", escape = "none")]
struct Header<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    upper: String,
    host: &'static str,
    answer_bytes: u32,
    registers: &'a [Register],
    refusals: &'a [Refusal],
}

#[derive(Template)]
#[template(path = "registers/efsat_registers.svd", escape = "none")]
struct Description<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    core: &'a str,
    version: &'static str,
    registers: &'a [Register],
}

#[derive(Template)]
#[template(path = "registers/efsat_registers_tb.vhd", escape = "none")]
struct Bench<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    has_caches: bool,
    places: u32,
    patience: u32,
    first_line: String,
    reset_reason: &'a str,
    half_period: &'a str,
    memory_signals: &'a str,
    memory_process: &'a str,
}

/// Reads of a status that does not change, after which the testbench gives up.
const PATIENCE: u32 = 20_000;

/// The ports of AXI4-Lite, as all templates have them.
const LITE_PORTS: &str = include_str!("../../templates/registers/lite_ports.vhd");
/// Registers whose value is that after reset.
const CONSTANTS: [&str; 4] = ["identity", "version", "parameters", "core"];

/// The names of ports, each in a line of its own.
fn names(ports: &str) -> Vec<&str> {
    ports.lines().filter_map(|line| Some(line.split_once(" : ")?.0.trim())).collect()
}

/// Text as pages have it, without what Markdown marks it with.
fn plain(text: &str) -> String {
    text.replace(['*', '`'], "")
}

fn xml(text: &str) -> String {
    plain(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The list as files print it.
fn printed(list: &[registers::Register]) -> Vec<Register> {
    let field = |field: &registers::Field| Field {
        name: field.name,
        upper: field.name.to_uppercase(),
        wide: field.bits > 1,
        low: field.low,
        high: field.high(),
        mask: format!("{:08x}", field.mask()),
        what: plain(field.what),
        xml: xml(field.what),
    };
    let register = |register: &registers::Register| Register {
        name: register.name,
        upper: register.name.to_uppercase(),
        at: format!("{:03x}", register.offset),
        access: register.access.name(),
        svd_access: match register.access {
            Access::Read => "read-only",
            Access::Write => "write-only",
            Access::ReadWrite | Access::Clear => "read-write",
        },
        clears: register.access == Access::Clear,
        read_effect: register.read_effect,
        reset: format!("{:08x}", register.reset),
        what: plain(register.what),
        xml: xml(register.what),
        fields: register.fields.iter().map(field).collect(),
    };
    list.iter().map(register).collect()
}

fn refusals() -> Vec<Refusal> {
    let refusal = |(name, code, what): (&'static str, u32, &'static str)| Refusal {
        name,
        upper: name.to_uppercase(),
        code,
        bits: format!("{code:03b}"),
        what,
    };
    registers::REFUSALS.map(refusal).into()
}

/// All registers that there are as a table in Markdown.
pub fn table() -> String {
    let list = registers::registers(Behind::Engine { by_number: false, caches: true }, 0);
    let mut text =
        "| address | register | access | after reset | bits | what it is |\n| --- | --- | --- | ---: | --- | --- |\n"
            .to_owned();
    for register in &list {
        let reset = match register.name {
            "version" | "parameters" | "core" => "constant".to_owned(),
            _ => format!("{:x}", register.reset),
        };
        let row = [
            format!("`{:03x}`", register.offset),
            format!("`{}`", register.name),
            register.access.name().to_owned(),
            reset,
            if register.fields.is_empty() { "31..0".to_owned() } else { String::new() },
            register.what.to_owned(),
        ];
        writeln!(text, "| {} |", row.join(" | ")).expect("a string takes text");
        // A mask has the fields of what it masks, without words of their own.
        for field in register.fields.iter().filter(|field| !field.what.is_empty()) {
            let bits = if field.bits == 1 { field.low.to_string() } else { format!("{}..{}", field.high(), field.low) };
            writeln!(text, "| | `.{}` | | | {bits} | {} |", field.name, field.what).expect("a string takes text");
        }
    }
    text
}

/// The reasons of refusals as a table in Markdown.
pub fn refusal_table() -> String {
    let rows = registers::REFUSALS.iter().map(|(name, code, what)| format!("| {code} | `{name}` | {what} |\n"));
    "| `refusal.why` | name | the access |\n| ---: | --- | --- |\n".to_owned() + &rows.collect::<String>()
}

impl Shell<'_> {
    /// The registers.
    pub fn registers(&self) -> Vec<registers::Register> {
        registers::registers(self.behind, register_script::hash(self.options))
    }

    /// Adds all files; what each is.
    pub fn add(&self, set: &mut FileSet) -> Vec<FileRow> {
        let Self { prefix, core, answer_bits, .. } = *self;
        let (is_engine, has_caches) = match self.behind {
            Behind::Unit => (false, false),
            Behind::Engine { caches, .. } => (true, caches),
        };
        let (header, list) = (&origin()[..], self.registers());
        let (registers, refusals) = (&printed(&list)[..], &refusals()[..]);
        let named = |wanted: fn(Access) -> bool| {
            list.iter().filter(|register| wanted(register.access)).map(|register| register.name).collect()
        };
        let answer = Bits::all(answer_bits);
        let map = Map { header, prefix, address: Bits::all(registers::ADDRESS_BITS), registers, refusals };
        let entity = Entity {
            header,
            prefix,
            core,
            is_engine,
            has_caches,
            has_high: answer_bits > 32,
            places: PLACES,
            place_bits: PLACES.trailing_zeros(),
            answer,
            last_place: answer_bits,
            report_words: self.report.0,
            reset_reason: &self.report.1,
            query_kind: &self.query_kind,
            registers,
            read: named(Access::reads),
            written: named(Access::writes),
            constants: &CONSTANTS,
        };
        let around = Around {
            header,
            prefix,
            core,
            is_engine,
            answer,
            more_ports: self.more_ports.trim_matches('\n'),
            more_names: names(&self.more_ports),
            lite_ports: names(LITE_PORTS),
        };
        let bench = Bench {
            header,
            prefix,
            has_caches,
            places: PLACES,
            patience: PATIENCE,
            first_line: register_script::first_line(self.options),
            reset_reason: &self.report.1,
            half_period: &self.half_period,
            memory_signals: self.memory[0].trim_end(),
            memory_process: self.memory[1].trim_end(),
        };
        let c = Header {
            header,
            prefix,
            upper: prefix.of("efsat_registers").to_uppercase(),
            host: if is_engine { "efsat_engine.h" } else { "efsat.h" },
            answer_bytes: answer_bits / 8,
            registers,
            refusals,
        };
        let svd = Description { header, prefix, core, version: env!("CARGO_PKG_VERSION"), registers };
        let files = FileLists::registers_bench(prefix);
        let [map_file, entity_file, shell_file] = FileLists::registers(prefix);
        let (header_file, svd_file) =
            (format!("host/{prefix}efsat_registers.h"), format!("{prefix}efsat_registers.svd"));
        let texts = [
            (
                &map_file,
                map.render(),
                "Where the registers are: addresses, values after reset and fields as VHDL constants.",
            ),
            (&entity_file, entity.render(), "Registers behind AXI4-Lite, two queues and an interrupt."),
            (&shell_file, around.render(), "The core behind the registers, for a processor without a DMA engine."),
            (&header_file, c.render(), "The registers in C, and functions that send and receive words."),
            (&svd_file, svd.render(), "The registers as CMSIS-SVD, for debuggers and generators."),
            (&files.file, bench.render(), "Testbench of the registers, for simulation only."),
        ];
        let mut rows = vec![];
        for (name, text, what) in texts {
            set.insert(name, text.expect("the template renders"));
            rows.push(FileRow::new(name, what));
        }
        set.insert(&files.vectors, self.script.clone());
        rows.push(FileRow::new(
            &files.vectors,
            "Accesses, legal and not, packets by the queues, interrupts and resets, with what must come of them.",
        ));
        rows
    }
}
