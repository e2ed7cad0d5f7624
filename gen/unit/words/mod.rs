//! The words of the stream: how pairs, poses and verdicts travel through the words of an AXI4-Stream (docs/stream.md).
//!
//! A packet is one header word and then records: any number of pairs, or one pose. A record is a row of little-endian
//! fields, padded with zeros to whole words:
//!
//! ```text
//! bits 31..0    flags: bit i is the sticky bit of number i (sticky designs); bit 31 of a pose is its bypass
//! bits 63..32   tag of a pair (bits 95..32 of 128 where the tag is wider than 32 bits), zero in a pose
//! then          the numbers, sign-extended to 32 bits each, or to 64 where they are wider than 32
//! ```
//!
//! Every packet is answered by one packet: one word a pair, or one report. An answer is `status` (8 bits), tag,
//! separated and overlapping axes, side by side from bit 0, in the narrowest of the legal words.

mod answer;
// For the engine, which has its own package of constants.
#[doc(hidden)]
pub mod constants;
mod format;
mod record;
// For the engine, the program and the testbench.
#[doc(hidden)]
pub mod registers;
mod word;

pub use answer::{AnswerFields, MALFORMED, OUTSIDE, REASON_AT, REPORT, STATUS_BITS, StreamReport, verdict_status};
pub use format::{BYPASS_AT, PacketKind, StreamFormat, TAG_AT};
// For the engine and the testbench.
#[doc(hidden)]
pub use record::Record;
pub use word::StreamWidth;
// For the engine and the testbench.
#[doc(hidden)]
pub use word::StreamWord;
