//! The memories of an engine, for a prediction of its block RAM.

use super::EngineDesign;
use super::values::Values;
use crate::words::EngineAnswer;
use efsat_hardware::device::block_rams;

/// Bits of a word of an answer, and whether it is the last.
const ANSWER_BITS: u32 = 65;
/// Bits of a pair of triangles in its queue.
const PAIR_BITS: u32 = 2 * EngineAnswer::NUMBER_BITS;

impl EngineDesign {
    /// Block RAMs of 18 kbit that the engine is expected to take: of its memory or its caches, its stacks and its queue of pairs; of
    /// several each.
    pub fn block_rams(&self) -> u64 {
        let values = Values::new(self);
        let of = |places: u32, bits: u32| block_rams(places.into(), bits.into());
        let memories = &values.memory.memories[usize::from(self.by_number)..];
        let stores = memories.iter().map(|lines| {
            let banks = u64::from(lines.words_per_line) * of(lines.lines, lines.word_bits);
            // A cache for each of the two trees, with tags and a bit that says whether there is one, and words on their way.
            let around = || of(lines.lines, lines.tag_bits + 1) + of(lines.return_words, lines.word_bits);
            if values.axi { 2 * (banks + around()) } else { banks }
        });
        if self.by_number {
            return stores.sum();
        }
        stores.sum::<u64>()
            + u64::from(self.params.queries) * of(values.traversal.stack_places, values.traversal.entry_bits)
            + of(values.traversal.all_pairs, PAIR_BITS)
            + if values.engines.several { of(values.engines.answer_places, ANSWER_BITS) } else { 0 }
    }
}
