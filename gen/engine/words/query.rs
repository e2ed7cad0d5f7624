//! The words that an engine takes: what they ask for.

/// Places of the flags in the query's word 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueryFlags;

impl QueryFlags {
    /// Stop at the first certain contact.
    pub const FIRST_CONTACT: u32 = 32;
    /// Answer separate pairs too.
    pub const ALL_PAIRS: u32 = 33;
    /// No triangle test: leaf pairs are answered possibly incorrect.
    pub const LEAF_PAIRS: u32 = 34;
    /// Keep the caches of the query before: the images are still what they were.
    pub const KEEP_CACHES: u32 = 35;
    /// Place of the number that the report returns.
    pub const NUMBER_AT: u32 = 40;
    /// Its bits.
    pub const NUMBER_BITS: u32 = 24;
    /// How many numbers that are.
    pub const NUMBERS: u32 = 1 << Self::NUMBER_BITS;
}

/// What a packet to the engine asks for. The discriminant is the low byte of its header; 1 and 2 are pairs and poses for the
/// unit alone ([`Kind`](efsat_unit::words::PacketKind)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Command {
    /// Find the pairs of triangles that touch.
    Query = 3,
    /// Fill memory in block RAM.
    Load = 4,
    /// End a query that runs or waits.
    Stop = 5,
    /// Forget all work.
    Reset = 6,
    /// Test pairs of triangles that are named by their numbers.
    Numbers = 7,
}
