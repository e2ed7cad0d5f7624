//! An engine that takes pairs by number: what is said of it, and its vector file.

use super::EngineDesign;
use super::meshes::{cuboid, hills, turn};
use super::vectors::EngineVectors;
use crate::host::{Image, Numbers, TRIANGLES_AT};
use crate::model::ByNumber;
use crate::params::Memory;
use crate::words::{Command, Reason};
use efsat_unit::pair::Pose;
use efsat_unit::params::ParamError;
use std::ops::Range;

/// What its entities are for, in the order of the data; those of the memory come behind.
pub(super) const ENTITIES: [(&str, &str); 3] = [
    ("engine_number_command", "Packets in: pairs by number, loads and soft resets; what is none of them is reported."),
    ("efsat", "The triangle unit."),
    ("engine_number_answer", "Answers out, in order, and the reports."),
];

/// Where triangles are.
pub(super) fn memory(design: &EngineDesign) -> String {
    let params = &design.params;
    match params.memory {
        Memory::BlockRam => {
            format!("Triangles are in block RAM, at most {}, filled through the stream.", params.triangle_lines)
        }
        Memory::Axi => format!(
            "Triangles are in memory behind an AXI4 read master of {} bits, with caches of {}.",
            params.memory_width, params.triangle_lines
        ),
    }
}

/// What the header of its top says.
pub(super) fn description(design: &EngineDesign) -> Vec<String> {
    let format = &design.format;
    vec![
        "Pairs of triangles by number: a pose and the numbers of triangles in memory in, those that touch out.".to_owned(),
        String::new(),
        memory(design),
        String::new(),
        "In: packets of 64-bit words, the last with TLAST:".to_owned(),
        "  0      header 31..0; 33 answer separate pairs too; 35 keep the caches; 63..40 number that the report returns".to_owned(),
        "  1, 2   triangles of A and B: addresses / 64, and how many there are".to_owned(),
        "  3 ...  pose, as in packets of the stream wrapper".to_owned(),
        format!("  {} ...  a word for each pair: number of A's triangle 31..0, of B's 63..32", format.pairs_at()),
        "Out: for each packet one: the pairs that are not separate, in order, then a report of eight words.".to_owned(),
    ]
}

/// Pairs of two meshes by their numbers, packets that end early, and packets that are none.
///
/// # Errors
/// If the meshes are too large for the memory.
pub(super) fn samples(design: &EngineDesign) -> Result<String, ParamError> {
    let meshes = [hills(6), cuboid(3, 4, 2)];
    let images = Image::build(&[&meshes[0], &meshes[1]], &design.format).expect("small meshes");
    let images: Vec<&Image> = images.iter().collect();
    let (found, least) = (design.params.triangle_lines, meshes.iter().map(|mesh| mesh.faces().len() as u32).sum());
    if design.params.memory == Memory::BlockRam && found < least {
        let legal = format!("expected at least {least}, which the meshes of the testbench take");
        return Err(ParamError { option: "triangle-lines", found: found.to_string(), legal });
    }
    let numbers =
        Numbers::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let mut vectors = EngineVectors::new(design, &images);
    let sides = [0, 1].map(|i| vectors.side(i));
    let make = |[a, b]: [usize; 2], axis: usize, t: [f64; 3], pairs: Vec<[u32; 2]>| {
        let query = numbers.query([(images[a], sides[a]), (images[b], sides[b])], &turn(axis), &t);
        ByNumber::of_query(&query.expect("a pose inside the ranges"), pairs)
    };
    let grid =
        |a: Range<u32>, b: Range<u32>| -> Vec<[u32; 2]> { a.flat_map(|a| b.clone().map(move |b| [a, b])).collect() };
    // Of two objects; of one; as it lies, among them a triangle and itself.
    let third = grid(0..72, 0..12).into_iter().filter(|[a, b]| (a + b) % 3 == 0).collect();
    let crossing = ByNumber { number: 1, ..make([0, 1], 2, [2.5, 1.0, -1.0], third) };
    let of = |number: u32, pairs: &[[u32; 2]]| ByNumber { number, pairs: pairs.to_vec(), ..crossing.clone() };
    let itself = make([1, 1], 2, [0.5, 0.0, 0.0], grid(0..12, 0..12));
    let as_it_lies = Pose { bypass: true, ..Pose::identity(&design.unit.params) };
    vectors.numbers(&crossing);
    vectors.numbers(&ByNumber { number: 2, all_pairs: true, keep_caches: true, ..crossing.clone() });
    vectors.numbers(&ByNumber { number: 3, ..itself.clone() });
    vectors.numbers(&ByNumber { number: 4, pose: as_it_lies, keep_caches: true, ..itself });
    vectors.numbers(&ByNumber { number: 5, ..make([1, 0], 0, [-1.0, 2.0, 0.5], grid(0..3, 20..40)) });
    // Short packets, which are in the unit together, each under a pose of its own.
    let kept = |number: u32, t: f64, pairs: &[[u32; 2]], all_pairs: bool| {
        let packet = make([0, 1], 2, [t, 1.0, -1.0], pairs.to_vec());
        ByNumber { number, all_pairs, keep_caches: true, ..packet }
    };
    for i in 0..24u32 {
        let pairs = &crossing.pairs[(50 * i % 280) as usize..][..1 + (i % 5) as usize];
        vectors.numbers(&kept(0x100 + i, f64::from(i) / 8.0, pairs, i % 3 == 0));
    }
    // Pairs of triangles that are not there, as the first, in the midst, as the last one; the packet behind is as ever.
    for (number, at, pair) in
        [(6, 0, [72, 0]), (7, 5, [0, 12]), (8, 9, [u32::MAX, 0]), (9, 3, [0, 1 << 31]), (22, 6, [1 << 31, 0])]
    {
        let mut pairs = crossing.pairs[200..210].to_vec();
        pairs[at] = pair;
        vectors.numbers(&of(number, &pairs));
        vectors.numbers(&kept(0x200 + number, 2.5, &crossing.pairs[..3], true));
    }
    let malformed = |words: &[u64]| words.iter().map(|&word| (word, true)).collect::<Vec<_>>();
    let words = vectors.numbers_words(&of(10, &crossing.pairs[..4]));
    let format = design.format;
    let first = format.pairs_at() as usize;
    for other in [1 << 8, 1 << 32, 1 << 34, 1 << 36, 1 << 39, 4] {
        vectors.malformed(&malformed(&[vec![words[0] ^ other], words[1..].to_vec()].concat()), Reason::UnknownHeader);
    }
    // So many that reports wait for the host, and packets for reports.
    (0..24).for_each(|_| vectors.malformed(&malformed(&[0]), Reason::UnknownHeader));
    vectors.malformed(&malformed(&[format.order(Command::Stop, 7)]), Reason::UnknownHeader);
    vectors.malformed(&malformed(&[format.order(Command::Reset, 7), 0]), Reason::UnknownHeader);
    vectors.malformed(&malformed(&[format.order(Command::Reset, 7) | 1 << 39]), Reason::UnknownHeader);
    vectors.numbers(&of(10, &[]));
    (1..first).for_each(|length| vectors.malformed(&malformed(&words[..length]), Reason::TooShort));
    let with = |place: usize, change: &dyn Fn(&mut (u64, bool))| {
        let mut changed = malformed(&words);
        change(&mut changed[place]);
        changed
    };
    for place in [1, 2, 3, first - 1, first, words.len() - 1] {
        let mut short = with(place, &|word| word.1 = false);
        // Pairs before it would be answered.
        if place > first {
            short.drain(first..place);
        }
        vectors.malformed(&short, Reason::TooShort);
    }
    vectors.malformed(&with(0, &|word| word.1 = false), Reason::UnknownHeader);
    let above = 32 - format.transform_width;
    if above > 0 {
        for (place, bit) in [(4, 31), (first - 1, 63), (5, 63 - above + 1)] {
            vectors.malformed(&with(place, &|word| word.0 ^= 1 << bit), Reason::UnknownHeader);
        }
    }
    // Triangles that end beyond the memory.
    for (number, at, count) in [(11, 0, 0u32), (12, u32::MAX, 1), (13, 1 << 26, 1), (14, 0, u32::MAX)] {
        for side in 0..2 {
            let mut packet = of(number, &crossing.pairs[..3]);
            let (from, more) = if count == 0 { (u32::MAX - 1, 0) } else { (at, count) };
            packet.sides[side].triangles_at = from;
            packet.sides[side].triangles = packet.sides[side].triangles.max(more);
            let words = packet.words(&format);
            vectors.words_of_numbers(&packet, &words);
        }
    }
    vectors.numbers(&of(15, &crossing.pairs[..20]));
    if design.params.memory == Memory::BlockRam {
        refused_loads(&mut vectors, design);
    }
    // Soft resets: while nothing is to be done, while pairs are asked for, while others wait.
    vectors.wait();
    vectors.reset(40, Some(16));
    for clocks in [3, 30, 60, 90, 150] {
        vectors.numbers(&of(17, &crossing.pairs[..90]));
        vectors.numbers(&kept(18, 2.5, &crossing.pairs[200..210], true));
        vectors.reset(clocks, (clocks < 90).then_some(clocks));
        vectors.numbers(&of(19, &crossing.pairs[200..230]));
    }
    // A reset right behind pairs, while others come from memory and go to the unit.
    for clocks in 0..6 {
        vectors.numbers(&kept(20, 2.5, &crossing.pairs[..24], true));
        vectors.reset(clocks, Some(clocks));
        vectors.numbers(&kept(21, 2.5, &crossing.pairs[200..203], true));
    }
    // While answers wait for the host.
    for clocks in (20..80).step_by(6) {
        vectors.numbers(&kept(24, 2.5, &crossing.pairs[..40], true));
        vectors.reset(clocks, Some(clocks));
        vectors.numbers(&kept(25, 2.5, &crossing.pairs[200..203], true));
    }
    // Between the words of a packet: in its head, in its pose, between its pairs.
    for words_before in [1, 2, first - 1, first + 3] {
        vectors.reset_within(&words, words_before);
        vectors.numbers(&kept(23, 2.5, &crossing.pairs[200..203], true));
    }
    Ok(vectors.text().to_owned())
}

/// Loads that write nothing: below the triangles, and behind the memory.
fn refused_loads(vectors: &mut EngineVectors<'_>, design: &EngineDesign) {
    let mut load = |rest: &[u64], reason| vectors.refused_load(rest, reason);
    let lines = design.params.triangle_lines;
    for line in [lines, 2 * lines, TRIANGLES_AT - 1] {
        load(&[u64::from(TRIANGLES_AT + line) << 6, 0, 0, 0, 0, 0, 0, 0, 0], Reason::TooLong);
    }
    load(&[u64::from(TRIANGLES_AT + lines - 1) << 6, 0, 0], Reason::TooShort);
    for address in [0, 64, (1 << 31) + 8, 1 << 32] {
        load(&[address, 0], Reason::UnknownHeader);
    }
    load(&[1 << 31], Reason::TooShort);
    load(&[], Reason::TooShort);
}
