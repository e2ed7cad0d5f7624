//! The registers of a core behind AXI4-Lite (docs/registers.md): one list, of which the hardware, its constants in VHDL, a C header,
//! a table in Markdown and a CMSIS-SVD file are printed. So all of them agree.

use super::REASON_AT;

/// Places of each of the two queues of words.
pub const PLACES: u32 = 64;
/// Bits of an address.
pub const ADDRESS_BITS: u32 = 12;

/// Bits of a number of words in a queue, 0 to all.
const LEVEL_BITS: u32 = PLACES.trailing_zeros() + 1;
/// The version of this list; a later one may add registers and fields, and raises it where one changes.
const LAYOUT: u32 = 1;
/// "EFSA" in ASCII.
const IDENTITY: u32 = 0x4546_5341;

/// What is behind the registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Behind {
    /// The unit in its stream wrapper.
    Unit,
    /// The collision engine, or that of pairs by number; and whether it has caches.
    Engine {
        /// Pairs are named by the host.
        by_number: bool,
        /// Trees are behind caches.
        caches: bool,
    },
}

/// How a register may be accessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Read alone.
    Read,
    /// Written alone.
    Write,
    /// Both.
    ReadWrite,
    /// Both; a one that is written clears its bit.
    Clear,
}

impl Access {
    /// Its short name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Read => "R",
            Self::Write => "W",
            Self::ReadWrite => "RW",
            Self::Clear => "RW1C",
        }
    }

    /// Whether it can be read.
    pub fn reads(self) -> bool {
        self != Self::Write
    }

    /// Whether it can be written.
    pub fn writes(self) -> bool {
        self != Self::Read
    }
}

/// Bits of a register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// Its lowest bit.
    pub low: u32,
    /// How many bits it has.
    pub bits: u32,
    /// What it is.
    pub what: &'static str,
}

impl Field {
    const fn new(name: &'static str, low: u32, bits: u32, what: &'static str) -> Self {
        Self { name, low, bits, what }
    }

    /// Its highest bit.
    pub fn high(&self) -> u32 {
        self.low + self.bits - 1
    }

    /// Its bits in the word.
    pub fn mask(&self) -> u32 {
        (u32::MAX >> (32 - self.bits)) << self.low
    }
}

/// A register of 32 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    /// Its name.
    pub name: &'static str,
    /// Its address in bytes.
    pub offset: u32,
    /// How it may be accessed.
    pub access: Access,
    /// Its value after `aresetn`.
    pub reset: u32,
    /// Whether to read it has an effect.
    pub read_effect: bool,
    /// What it is.
    pub what: &'static str,
    /// Its fields; none if it is one number. Bits of no field are 0 when read and ignored when written.
    pub fields: Vec<Field>,
}

/// The interrupts, bits of the same places in `pending` and `mask`.
const INTERRUPTS: [Field; 5] = [
    Field::new("answer", 0, 1, "event: the last word of an answer has come"),
    Field::new("receive", 1, 1, "level: receive_level >= thresholds.receive"),
    Field::new("transmit", 2, 1, "level: transmit_level <= thresholds.transmit"),
    Field::new("fault", 3, 1, "event: a report says *malformed* or *incomplete*"),
    Field::new("refused", 4, 1, "event: an access was refused"),
];

/// Why an access is refused; the first that applies.
pub const REFUSALS: [(&str, u32, &str); 6] = [
    ("unaligned", 1, "the address is no multiple of 4"),
    ("unknown", 2, "there is no register at the address"),
    ("partial", 3, "a write without all four strobes"),
    ("direction", 4, "a write to a register that is only read, or a read of one that is only written"),
    ("full", 5, "the transmit queue is full"),
    ("empty", 6, "the receive queue is empty"),
];

/// The registers of a core whose parameters have that hash, by their addresses.
pub fn registers(behind: Behind, parameters: u32) -> Vec<Register> {
    let (is_engine, has_caches, kind) = match behind {
        Behind::Unit => (false, false, 0),
        Behind::Engine { by_number, caches } => (true, caches, 1 + u32::from(by_number)),
    };
    let register = |name, offset, access, what| Register {
        name,
        offset,
        access,
        reset: 0,
        read_effect: false,
        what,
        fields: vec![],
    };
    let field = Field::new;
    let [major, minor, patch] = version();
    let reason_bits = if is_engine { 5 } else { 2 };
    let mut report = vec![
        field("kind", 0, 2, "0 none since reset, 1 of the unit, 2 of the engine"),
        field("reason", REASON_AT, reason_bits, "why"),
        field("fault", 7, 1, "*malformed*, or *incomplete*"),
    ];
    report.extend(is_engine.then_some(field("number", 8, 24, "of the engine: the query's number")));
    let mut list = vec![
        Register { reset: IDENTITY, ..register("identity", 0x00, Access::Read, "\"EFSA\"") },
        Register {
            reset: LAYOUT << 24 | major << 16 | minor << 8 | patch,
            fields: vec![
                field("layout", 24, 8, "version of this list of registers"),
                field("major", 16, 8, "version of efsat"),
                field("minor", 8, 8, "of it"),
                field("patch", 0, 8, "of it"),
            ],
            ..register("version", 0x04, Access::Read, "what has made the design")
        },
        Register {
            reset: parameters,
            ..register("parameters", 0x08, Access::Read, "hash of the options: the first 32 bits of a SHA-256")
        },
        Register {
            reset: kind | PLACES << 8 | PLACES << 16,
            fields: vec![
                field("kind", 0, 2, "0 unit, 1 engine, 2 engine of pairs by number"),
                field("transmit_places", 8, 8, "words that the transmit queue holds"),
                field("receive_places", 16, 8, "words that the receive queue holds"),
            ],
            ..register("core", 0x0c, Access::Read, "what is behind the registers")
        },
        Register {
            fields: vec![
                field("enable", 0, 1, "words of the transmit queue go to the core"),
                field("soft_reset", 1, 1, "write 1: one soft reset; reads 0"),
            ],
            ..register("control", 0x10, Access::ReadWrite, "")
        },
        Register {
            fields: vec![
                field("transmit_level", 0, LEVEL_BITS, "words in the transmit queue"),
                field("receive_level", 8, LEVEL_BITS, "words in the receive queue"),
                field("receive_last", 16, 1, "the oldest of them is the last of its packet"),
                field("open", 17, 1, "the core has a packet but for its last word"),
            ],
            ..register("status", 0x14, Access::Read, "")
        },
        Register { fields: report, ..register("last_report", 0x18, Access::Read, "the last report that has come") },
        Register {
            fields: vec![
                field("count", 0, 16, "refused accesses, at most 65,535"),
                field("address", 16, ADDRESS_BITS, "address of the last one"),
                field("why", 28, 3, "why, as in the table below"),
            ],
            ..register("refusal", 0x1c, Access::Read, "")
        },
        register("transmit_low", 0x20, Access::Write, "bits 31..0 of the next word; kept for those after it"),
        register("transmit_high", 0x24, Access::Write, "bits 63..32: the word goes to the queue"),
        register("transmit_last", 0x28, Access::Write, "the same, of the last word of a packet"),
        register("receive_low", 0x30, Access::Read, "bits 31..0 of the oldest word"),
        Register {
            read_effect: true,
            ..register("receive_high", 0x34, Access::Read, "bits 63..32 of it: the word leaves the queue")
        },
        Register {
            reset: INTERRUPTS[2].mask(),
            fields: INTERRUPTS.into(),
            ..register("pending", 0x40, Access::Clear, "interrupts")
        },
        Register {
            fields: INTERRUPTS.map(|field| Field { what: "", ..field }).into(),
            ..register("mask", 0x44, Access::ReadWrite, "those that set `irq`, by the bits of `pending`")
        },
        Register {
            reset: 1 << 8,
            fields: vec![
                field("transmit", 0, LEVEL_BITS, "words, for the interrupt `transmit`"),
                field("receive", 8, LEVEL_BITS, "words, for the interrupt `receive`"),
            ],
            ..register("thresholds", 0x48, Access::ReadWrite, "")
        },
        register("packets_in", 0x50, Access::Read, "last words that were written"),
        register("packets_out", 0x54, Access::Read, "last words that have come"),
        register(
            "pairs",
            0x58,
            Access::Read,
            if is_engine { "pairs answered, by an engine counted when their packet ends" } else { "pairs answered" },
        ),
    ];
    list.extend(is_engine.then_some(register(
        "queries",
        0x5c,
        Access::Read,
        "of an engine: packets written that begin as a query does, or as pairs by number do",
    )));
    list.extend(has_caches.then_some(register(
        "cache_misses",
        0x60,
        Access::Read,
        "of an engine with caches: blocks and triangles read from memory, by the reports",
    )));
    list.extend([
        Register {
            read_effect: true,
            ..register(
                "clocks_low",
                0x64,
                Access::Read,
                "clocks since reset, bits 31..0; keeps the others for `clocks_high`",
            )
        },
        register("clocks_high", 0x68, Access::Read, "bits 63..32, at the last read of `clocks_low`"),
    ]);
    list
}

/// The version of the program.
fn version() -> [u32; 3] {
    let mut parts = env!("CARGO_PKG_VERSION").split(['.', '-', '+']).map(|part| part.parse().unwrap_or(0));
    std::array::from_fn(|_| parts.next().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const ALL: [Behind; 4] = [
        Behind::Unit,
        Behind::Engine { by_number: false, caches: true },
        Behind::Engine { by_number: false, caches: false },
        Behind::Engine { by_number: true, caches: true },
    ];

    #[test]
    fn no_two_registers_and_no_two_fields_share_a_place() {
        for behind in ALL {
            let list = registers(behind, 7);
            assert!(list.is_sorted_by_key(|register| register.offset));
            assert_eq!(list.iter().map(|register| register.offset).collect::<BTreeSet<_>>().len(), list.len());
            assert_eq!(list.iter().map(|register| register.name).collect::<BTreeSet<_>>().len(), list.len());
            for Register { name, offset, reset, fields, .. } in &list {
                assert!(offset % 4 == 0 && *offset < 1 << ADDRESS_BITS, "{name}");
                let mut used = 0u32;
                for field in fields {
                    assert!(field.high() < 32 && used & field.mask() == 0, "{name}.{}", field.name);
                    used |= field.mask();
                }
                assert!(fields.is_empty() || reset & !used == 0, "{name}: reset outside the fields");
            }
        }
    }

    #[test]
    fn a_register_is_at_one_address_whatever_is_behind() {
        let full = registers(ALL[1], 0);
        for behind in ALL {
            for register in registers(behind, 0) {
                let same = full.iter().find(|other| other.name == register.name).unwrap();
                assert_eq!((same.offset, same.access), (register.offset, register.access), "{}", register.name);
            }
        }
    }
}
