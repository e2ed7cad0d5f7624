//! The check of a block against its layout.

use super::*;
use efsat::engine::format::EngineFormat;
use efsat::engine::words::{BlockLayout, LEAF_BIT, NO_CHILD};

/// What is known of a block: for each child whether it is there, whether it is a leaf, whether the link is wrong, and its number;
/// then whether the block is bad.
#[derive(Clone, Copy)]
struct Due {
    children: [(bool, bool, bool, u64); 2],
    bad: bool,
}

struct Blocks {
    rng: ChaCha8Rng,
    layout: BlockLayout,
    format: EngineFormat,
}

impl Blocks {
    /// A block that is good but for one thing at times: words, its number, numbers of blocks and triangles, and what is due.
    fn next(&mut self) -> ([u64; 8], u64, [u64; 2], Due) {
        let rng = &mut self.rng;
        let own = rng.random_range(0..100);
        // More blocks than the number of a block has bits for: those beyond are astray, too.
        let blocks = if seldom(rng, 4) { u32::MAX.into() } else { rng.random_range(90..200) };
        let counts: [u64; 2] = [blocks, rng.random_range(1..300)];
        let mut words = [0u64; 8];
        let mut put = |at: u32, bits: u32, value: u64| {
            for i in 0..bits {
                words[((at + i) / 64) as usize] |= (value >> i & 1) << ((at + i) % 64);
            }
        };
        let link = |rng: &mut ChaCha8Rng| match rng.random_range(0..8) {
            0 => NO_CHILD,
            1..4 => 1 << LEAF_BIT | rng.random_range(0..310),
            // Bits that no number has.
            4 if seldom(rng, 4) => rng.random_range(90..110) | 1 << rng.random_range(24..31),
            _ => rng.random_range(0..210),
        };
        let links: [u32; 2] = [link(rng), link(rng)];
        for (child, link) in (0..).zip(links) {
            put(BlockLayout::link_at(child), BlockLayout::LINK_BITS, link.into());
        }
        put(self.layout.origin_at, 3 * self.layout.origin_bits + BlockLayout::EXPONENT_BITS, rng.random());
        let wrong = seldom(rng, 4);
        // The bits between tag and codes are a part of it, and zero.
        let tag_bits = BlockLayout::CODES_AT - self.layout.tag_at;
        let flipped = if wrong && seldom(rng, 2) { 1 << rng.random_range(0..tag_bits) } else { 0 };
        put(self.layout.tag_at, tag_bits, u64::from(self.layout.tag) ^ flipped);
        let (most, count) = (self.format.most(), 2 * self.layout.directions);
        let unusable = (wrong && flipped == 0).then(|| rng.random_range(0..count));
        for i in 0..count {
            let code = if unusable == Some(i) { -most - 1 } else { rng.random_range(-most..=most) };
            put(
                self.layout.code_at(i / self.layout.directions, i % self.layout.directions),
                self.layout.code_bits,
                code as u64,
            );
        }
        let child = |link: u32| {
            let (leaf, target) = (link >> LEAF_BIT == 1, u64::from(link & !(1 << LEAF_BIT)));
            let fault = if leaf { target >= counts[1] } else { target >= counts[0].min(1 << 24) || target <= own };
            (link != NO_CHILD, leaf, fault, target & 0xfff_ffff)
        };
        (words, own, counts, Due { children: links.map(child), bad: wrong })
    }
}

fn children(entity: &mut Entity) -> Outcome {
    let format = small(Memory::Axi).format;
    let mut blocks = Blocks { rng: random(2), layout: format.block(), format };
    entity.reset();
    // Of the blocks one to three clocks ago, and whether they were taken.
    let mut before: [Option<(bool, Due)>; 3] = [None; 3];
    for clock in 0..1500 {
        let (words, own, counts, due) = blocks.next();
        let taken = !seldom(&mut blocks.rng, 3);
        entity.set_words("data", &words);
        entity.set("own", own);
        entity.set("taken", taken.into());
        entity.settle();
        if let Some((_, due)) = before[0] {
            let [present, leaf, fault] = ["present", "leaf", "fault"].map(|port| entity.get(port));
            for (i, (there, is_leaf, wrong, number)) in due.children.into_iter().enumerate() {
                expect(present >> i & 1 == u64::from(there), clock, "present")?;
                if there {
                    expect(leaf >> i & 1 == u64::from(is_leaf), clock, "leaf")?;
                    expect(fault >> i & 1 == u64::from(wrong), clock, "fault")?;
                    expect(entity.get(["left", "right"][i]) == number, clock, "number")?;
                }
            }
        }
        if let Some((taken, due)) = before[2] {
            expect(entity.is("bad") == (taken && due.bad), clock, "bad")?;
        }
        entity.clock();
        // The counts are those of the query, and are compared in the clock after.
        entity.set("block_count", counts[0]);
        entity.set("triangle_count", counts[1]);
        before = [Some((taken, due)), before[0], before[1]];
    }
    Ok(())
}

#[test]
fn blocks_and_links_are_checked() {
    let changes = [
        ("target <= unsigned(number)", "target < unsigned(number)"),
        ("beyond <= '1' when target >= unsigned", "beyond <= '1' when target > unsigned"),
        ("all_parts := all_parts and part_before(p);", "all_parts := all_parts;"),
        (
            "part(1)(35) <= '1' when data(509 downto 506) = \"0000\"",
            "part(1)(35) <= '1' when data(509 downto 506) = \"1111\"",
        ),
        ("or alien = '1'", ""),
        ("judged <= taken_before and not reset;", "judged <= '1';"),
        ("data(151 downto 150) /= \"00\"", "data(150 downto 150) /= \"0\""),
        ("target(30 downto node_bits) /= 0", "target(29 downto node_bits) /= 0"),
    ];
    tried(&small(Memory::Axi), "engine_children", &changes, children);
}
