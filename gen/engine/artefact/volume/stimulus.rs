//! Seeded expansions for a volume unit: common ones, ones at the ends of all ranges, and ones whose answer hangs on one step
//! of the grid; with the answers of the reference model.

use crate::design::volume_unit::{VolumeDesign, WordPort};
use crate::format::EngineFormat;
use crate::model::{Block, Frame, Link, Opened, QueryRow, apart, distance, overlap};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::HashMap;
use std::fmt::Write;

/// Two blocks under a query.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// Which query.
    pub frame: usize,
    /// The blocks of A and B.
    pub blocks: [Block; 2],
    /// Which children of A and of B take part: left, right.
    pub take: [[bool; 2]; 2],
}

/// Queries, and expansions in the order in which they are sent, those of a query together.
pub struct VolumeStimulus {
    format: EngineFormat,
    /// The queries.
    pub frames: Vec<Frame>,
    /// The expansions.
    pub expansions: Vec<Expansion>,
}

/// Thresholds to each query with common expansions; three expansions each.
const THRESHOLDS: usize = 3;
/// Common expansions of a query.
const OF_A_QUERY: usize = 6;

impl VolumeStimulus {
    /// Expansions of one query.
    pub fn of(format: &EngineFormat, frame: Frame, opened: Vec<Opened>) -> Self {
        let expansion = |Opened { blocks, take }| Expansion { frame: 0, blocks, take };
        Self { format: *format, frames: vec![frame], expansions: opened.into_iter().map(expansion).collect() }
    }

    /// At least so many expansions.
    pub fn random(format: &EngineFormat, expansions: usize, seed: u64) -> Self {
        let mut all = Self { format: *format, frames: vec![], expansions: vec![] };
        let mut random = Random { format: *format, rng: ChaCha8Rng::seed_from_u64(seed) };
        while all.expansions.len() < expansions {
            let frame = random.frame(false);
            let blocks = (0..OF_A_QUERY).map(|_| random.near(&frame)).collect();
            all.query(&mut random, frame, blocks);
            let frame = random.frame(true);
            let blocks = vec![random.extreme(), random.extreme()];
            all.query(&mut random, frame, blocks);
            for _ in 0..THRESHOLDS {
                for (frame, blocks) in random.threshold() {
                    all.query(&mut random, frame, vec![blocks]);
                }
            }
        }
        all
    }

    fn query(&mut self, random: &mut Random, frame: Frame, blocks: Vec<[Block; 2]>) {
        self.frames.push(frame);
        let frame = self.frames.len() - 1;
        for blocks in blocks {
            let take = [(); 2].map(|()| [(); 2].map(|()| random.rng.random_range(0..5) > 0));
            self.expansions.push(Expansion { frame, blocks, take });
        }
    }

    /// The answer of the reference model, as the unit gives it.
    pub fn answer(&self, expansion: &Expansion) -> u32 {
        let Expansion { frame, blocks: [a, b], take: [of_a, of_b] } = expansion;
        let survives =
            |p: usize, q: usize| of_a[p] && of_b[q] && overlap(&self.frames[*frame], [a, b], [p, q], &self.format);
        (0..4).map(|pair| u32::from(survives(pair / 2, pair % 2)) << pair).sum()
    }

    /// The numbers of an expansion with its query, by the ports of the stage.
    pub fn numbers(&self, expansion: &Expansion) -> HashMap<String, i128> {
        let mut numbers = HashMap::new();
        let mut put = |port: String, value: i64| _ = numbers.insert(port, i128::from(value));
        let frame = &self.frames[expansion.frame];
        for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
            (0..3).for_each(|row| put(format!("query_pose{row}_{axis}"), frame.matrix[row][i]));
            put(format!("query_shift_{axis}"), frame.shift[i]);
            put(format!("query_error_{axis}"), frame.errors[i].into());
            for (of, block) in ["a", "b"].into_iter().zip(&expansion.blocks) {
                put(format!("{of}_origin_{axis}"), block.origin[i].into());
            }
        }
        for (i, row) in frame.rows.iter().enumerate() {
            for (slot, (choice, factor)) in row.terms.iter().enumerate() {
                put(format!("query_row{i}_choice{slot}"), (*choice).into());
                put(format!("query_row{i}_factor{slot}"), (*factor).into());
            }
            put(format!("query_row{i}_rest"), row.rest.into());
        }
        for (k, of) in ["a", "b"].into_iter().enumerate() {
            let block = &expansion.blocks[k];
            put(format!("{of}_exponent"), block.exponent.into());
            for child in 0..2 {
                put(format!("{of}_take{child}"), expansion.take[k][child].into());
                for (h, code) in block.codes[child].iter().enumerate() {
                    put(format!("{of}_code{child}_{h}"), (*code).into());
                }
            }
        }
        numbers
    }

    /// The lines of a vector file: `Q` and the words of a query, or `E`, the words of an expansion and its answer.
    pub fn text(&self, design: &VolumeDesign) -> String {
        let (query, given): (Vec<_>, Vec<_>) = design.words().into_iter().partition(WordPort::of_query);
        let mut text = String::new();
        let mut frame = None;
        for expansion in &self.expansions {
            let numbers = self.numbers(expansion);
            let digits = |word: &WordPort| match word.name {
                // As the host writes them, links and tag included.
                "in_block_a" => of_memory(&expansion.blocks[0], &self.format),
                "in_block_b" => of_memory(&expansion.blocks[1], &self.format),
                _ => hexadecimal(word, &numbers),
            };
            let line = |words: &[WordPort]| words.iter().map(digits).collect::<Vec<_>>().join(" ");
            if frame.replace(expansion.frame) != Some(expansion.frame) {
                let _ = writeln!(text, "Q {}", line(&query));
            }
            let _ = writeln!(text, "E {} {:x}", line(&given), self.answer(expansion));
        }
        text
    }
}

/// A word of numbers in hexadecimal digits.
fn hexadecimal(word: &WordPort, numbers: &HashMap<String, i128>) -> String {
    let mut bits = vec![false; word.bits.next_multiple_of(4) as usize];
    for (port, low, width) in &word.numbers {
        (0..*width).for_each(|bit| bits[(low + bit) as usize] = numbers[port] >> bit & 1 == 1);
    }
    let digit = |nibble: &[bool]| nibble.iter().rev().fold(0, |digit, bit| 2 * digit + u32::from(*bit));
    bits.chunks(4).rev().map(|nibble| char::from_digit(digit(nibble), 16).expect("four bits")).collect()
}

/// A block as it is in memory, in hexadecimal digits.
fn of_memory(block: &Block, format: &EngineFormat) -> String {
    block.words(format).iter().rev().map(|word| format!("{word:016x}")).collect()
}

/// What draws queries and blocks.
struct Random {
    format: EngineFormat,
    rng: ChaCha8Rng,
}

impl Random {
    /// A number of random size up to a bound.
    fn up_to(&mut self, bound: i64) -> i64 {
        let bits = self.rng.random_range(0..=64 - bound.leading_zeros());
        self.rng.random_range(0..=bound.min((1 << bits) - 1))
    }

    /// A number of random size and sign; with `ends` one end of its range or zero.
    fn signed(&mut self, bound: i64, ends: bool) -> i64 {
        let magnitude = if ends { bound } else { self.up_to(bound) };
        magnitude * self.rng.random_range(-1..=1)
    }

    /// A count; with `ends` none or the greatest.
    fn count(&mut self, bits: u32, ends: bool) -> u32 {
        let most = (1 << bits) - 1;
        if ends { most * self.rng.random_range(0..=1) } else { self.rng.random_range(0..=most) }
    }

    fn frame(&mut self, ends: bool) -> Frame {
        let format = self.format;
        let widths = format.widths();
        let row = |random: &mut Self| QueryRow {
            terms: format
                .directions
                .slots()
                .map(|slot| (random.rng.random_range(0..slot.len() as u32), random.count(format.factor_bits, ends))),
            rest: random.count(format.rest_bits(), ends),
        };
        Frame {
            matrix: [(); 3].map(|()| [(); 3].map(|()| self.signed(widths.origin.bound, ends))),
            shift: [(); 3].map(|()| if ends { self.signed(widths.translation.bound, true) } else { 0 }),
            errors: [(); 3].map(|()| self.count(format.shift_error_bits(), ends)),
            rows: (0..format.rows()).map(|_| row(self)).collect(),
        }
    }

    fn block(&mut self, exponent: u32, mut code: impl FnMut(&mut Self) -> i64) -> Block {
        let bound = self.format.widths().origin.bound;
        Block {
            links: [Link::Leaf(1), Link::Inner(2)],
            origin: [(); 3].map(|()| self.signed(bound, false) as i32),
            exponent,
            codes: [(); 2].map(|()| (0..self.format.k()).map(|_| code(self) as i32).collect()),
        }
    }

    /// Blocks whose origins are near each other, by the size of the volumes.
    fn near(&mut self, frame: &Frame) -> [Block; 2] {
        let most = i64::from(self.format.most());
        let exponent = self.rng.random_range(0..16);
        let [mut a, b] = [(); 2].map(|()| {
            let exponent = (exponent + self.rng.random_range(0..2)).min(15);
            let least = self.rng.random_range(0..=most / 2);
            self.block(exponent, |random| random.rng.random_range(-least..=most))
        });
        let step = self.format.origin_shift();
        for (i, d) in distance(frame, &a, &b, &self.format).into_iter().enumerate() {
            let noise = self.signed(most << exponent, false);
            let bound = self.format.widths().origin.bound;
            let to = i64::from(a.origin[i]) + ((d + noise) >> step);
            a.origin[i] = to.clamp(-bound, bound) as i32;
        }
        [a, b]
    }

    /// Blocks with numbers at the ends of their ranges.
    fn extreme(&mut self) -> [Block; 2] {
        let (most, bound) = (i64::from(self.format.most()), self.format.widths().origin.bound);
        [(); 2].map(|()| {
            let exponent = 15 * self.rng.random_range(0..=1);
            let mut block = self.block(exponent, |random| random.signed(most, true));
            block.origin = [(); 3].map(|()| self.signed(bound, true) as i32);
            block
        })
    }

    /// One pair of blocks under three queries: the shift along one axis is the greatest at which a direction has the left
    /// children apart, and one step to either side. In all other directions they overlap by far.
    fn threshold(&mut self) -> Vec<(Frame, [Block; 2])> {
        let format = self.format;
        let most = i64::from(format.most());
        let mut frame = self.frame(false);
        let mut a = self.block(15, |_| most);
        let exponent = self.rng.random_range(0..10);
        let mut b = self.block(exponent, |random| random.signed(most, false));
        (a.origin, b.origin) = ([0; 3], b.origin.map(|x| x >> 4));
        let h = self.rng.random_range(0..format.directions.count());
        a.codes[0][h ^ 1] = self.rng.random_range(-most / 8..=0) as i32;
        let axes: Vec<usize> = (0..3).filter(|i| format.directions.vector(h)[*i] != 0).collect();
        let axis = axes[self.rng.random_range(0..axes.len())];
        let sign = i64::from(format.directions.vector(h)[axis]);
        let is_apart =
            |frame: &Frame| apart(h, &distance(frame, &a, &b, &format), frame, &a.volume(0), &b.volume(0), &format);
        // Apart at the lower end, not at the upper one.
        let bound = format.widths().translation.bound;
        let (mut low, mut high) = (-bound, bound);
        while high - low > 1 {
            let middle = (low + high) >> 1;
            frame.shift[axis] = sign * middle;
            if is_apart(&frame) { low = middle } else { high = middle }
        }
        let at = |step: i64| {
            let mut frame = frame.clone();
            frame.shift[axis] = sign * (low + step).clamp(-bound, bound);
            (frame, [a.clone(), b.clone()])
        };
        vec![at(0), at(1), at(2)]
    }
}
