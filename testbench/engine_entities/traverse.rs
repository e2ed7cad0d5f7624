//! The traversal of random trees against a recursive one: the same leaf pairs and counts, whatever the order of both.

use super::*;
use efsat::engine::words::{BlockLayout, LEAF_BIT, NO_CHILD};
use std::collections::VecDeque;

/// Both children of a block: links as a block has them.
type Links = [u32; 2];

/// A tree: its blocks, and triangles up to a count.
struct Tree {
    blocks: Vec<Links>,
    triangles: u32,
}

/// Nodes of a pair: a block, and which of its children are meant.
type Node = (u32, [bool; 2]);

/// What a traversal comes to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Found {
    pairs: Vec<[u64; 2]>,
    expansions: u64,
    tests: u64,
    survivors: u64,
    /// Survivors that no good tree has.
    wrong: u64,
}

impl Tree {
    /// So many levels at most; children are missing at times.
    fn new(rng: &mut ChaCha8Rng, height: u32) -> Self {
        let mut tree = Self { blocks: vec![], triangles: 0 };
        tree.node(rng, height);
        tree
    }

    /// A chain of blocks, each with the next one and a leaf.
    fn chain(height: u32) -> Self {
        let leaf = |number| 1 << LEAF_BIT | number;
        let link = |block| [if block + 1 < height { block + 1 } else { leaf(height) }, leaf(block)];
        Self { blocks: (0..height).map(link).collect(), triangles: height + 1 }
    }

    fn node(&mut self, rng: &mut ChaCha8Rng, height: u32) -> u32 {
        let number = self.blocks.len();
        self.blocks.push([NO_CHILD; 2]);
        for child in 0..2 {
            self.blocks[number][child] = match rng.random_range(0..10) {
                0 => NO_CHILD,
                1..8 if height > 1 => self.node(rng, height - 1),
                _ => {
                    self.triangles += 1;
                    1 << LEAF_BIT | (self.triangles - 1)
                }
            };
        }
        number as u32
    }

    /// A link that goes to no triangle, no block, or back.
    fn damage(&mut self, rng: &mut ChaCha8Rng) {
        let block = rng.random_range(0..self.blocks.len());
        let link = &mut self.blocks[block][rng.random_range(0..2)];
        if *link == NO_CHILD {
            return;
        }
        *link = match (*link >> LEAF_BIT, rng.random::<bool>()) {
            (1, _) => 1 << LEAF_BIT | self.triangles,
            (_, true) => block as u32,
            (_, false) => 0x100_0000,
        };
    }

    fn words(&self, block: u32, layout: &BlockLayout) -> Vec<u64> {
        let [left, right] = self.blocks[block as usize].map(u64::from);
        let mut words = vec![0; 8];
        words[0] = right << 32 | left;
        let tag = u128::from(layout.tag) << (layout.tag_at % 64);
        words[layout.tag_at as usize / 64] |= tag as u64;
        words[layout.tag_at as usize / 64 + 1] |= (tag >> 64) as u64;
        words
    }

    /// Whether the link of a child is wrong, and whether it is a leaf.
    fn child(&self, block: u32, child: usize) -> (bool, bool) {
        let link = self.blocks[block as usize][child];
        let (leaf, target) = (link >> LEAF_BIT == 1, link & !(1 << LEAF_BIT));
        (if leaf { target >= self.triangles } else { target >= self.blocks.len() as u32 || target <= block }, leaf)
    }

    /// The node of a child; a leaf stays in its block.
    fn below(&self, (block, _): Node, child: usize) -> Node {
        let link = self.blocks[block as usize][child];
        if link >> LEAF_BIT == 1 { (block, [child == 0, child == 1]) } else { (link, [true; 2]) }
    }
}

/// Whether children of two blocks may overlap: always the same for the same children.
fn overlap(seed: Option<u64>, blocks: [u32; 2], [p, q]: [usize; 2]) -> bool {
    let Some(seed) = seed else { return true };
    let key = (u64::from(blocks[0]) << 34 | u64::from(blocks[1]) << 4 | (2 * p + q) as u64) ^ seed;
    !ChaCha8Rng::seed_from_u64(key).random_range(0..8u32).is_multiple_of(3)
}

/// Two trees, which children of them overlap, and how deep an entry of the stack may be.
struct Query {
    trees: [Tree; 2],
    /// None: all do.
    seed: Option<u64>,
    deepest: u32,
}

impl Query {
    fn expand(&self, [a, b]: [Node; 2], level: u32, found: &mut Found) {
        found.expansions += 1;
        let there =
            |tree: &Tree, (block, meant): Node| [0, 1].map(|i| meant[i] && tree.blocks[block as usize][i] != NO_CHILD);
        let (in_a, in_b) = (there(&self.trees[0], a), there(&self.trees[1], b));
        let count = |there: [bool; 2]| there.into_iter().filter(|&there| there).count() as u64;
        found.tests += count(in_a) * count(in_b);
        let lives = |p: usize, q: usize| in_a[p] && in_b[q] && overlap(self.seed, [a.0, b.0], [p, q]);
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            if !lives(p, q) {
                continue;
            }
            found.survivors += 1;
            let (wrong_a, leaf_a) = self.trees[0].child(a.0, p);
            let (wrong_b, leaf_b) = self.trees[1].child(b.0, q);
            let both = leaf_a && leaf_b;
            // A leaf beside an inner node stays where it is: its link is not followed yet.
            if (wrong_a && (both || !leaf_a)) || (wrong_b && (both || !leaf_b)) || (level == self.deepest && !both) {
                found.wrong += 1;
                continue;
            }
            if both {
                let number = |tree: &Tree, block: u32, child: usize| {
                    u64::from(tree.blocks[block as usize][child] & !(1 << LEAF_BIT))
                };
                found.pairs.push([number(&self.trees[0], a.0, p), number(&self.trees[1], b.0, q)]);
                continue;
            }
            let (mut next_a, mut next_b) = (self.trees[0].below(a, p), self.trees[1].below(b, q));
            // Two leaves that meet the same inner node go together.
            let other_leaf = |tree: usize, node: Node, child: usize| self.trees[tree].child(node.0, 1 - child).1;
            if leaf_a && other_leaf(0, a, p) && lives(1 - p, q) {
                if p == 0 {
                    continue;
                }
                next_a = (a.0, [true; 2]);
            }
            if leaf_b && other_leaf(1, b, q) && lives(p, 1 - q) {
                if q == 0 {
                    continue;
                }
                next_b = (b.0, [true; 2]);
            }
            self.expand([next_a, next_b], level + 1, found);
        }
    }

    fn found(&self) -> Found {
        let mut found = Found::default();
        self.expand([(0, [true; 2]); 2], 0, &mut found);
        found.pairs.sort_unstable();
        found
    }
}

/// A pair in flight: its blocks, and from when on they, and then the answer, are there.
struct Flight {
    blocks: [u32; 2],
    due: usize,
    survive: u64,
}

struct Around<'a> {
    entity: &'a mut Entity,
    rng: ChaCha8Rng,
    layout: BlockLayout,
    clock: usize,
    found: Found,
    asked: VecDeque<Flight>,
    tested: VecDeque<Flight>,
    /// Clocks since the query has a reason to end.
    ended: Option<usize>,
    bad: bool,
    limited: bool,
}

impl Around<'_> {
    /// Blocks that are there and taken by the volume unit, if there are such.
    fn blocks(&mut self, query: &Query) -> bool {
        let taken = self.asked.front().is_some_and(|flight| flight.due <= self.clock) && !seldom(&mut self.rng, 3);
        self.entity.set("blocks_taken", taken.into());
        for (i, port) in ["block_a", "block_b"].into_iter().enumerate() {
            // What is not taken means nothing.
            let noise = [self.rng.random(); 8].to_vec();
            let flight = self.asked.front().filter(|_| taken);
            let words = flight.map_or(noise, |flight| query.trees[i].words(flight.blocks[i], &self.layout));
            self.entity.set_words(port, &words);
        }
        taken
    }

    /// The volume unit answers what it has taken: of children that are not meant that they do not overlap, of those that are
    /// not there anything.
    fn take(&mut self, query: &Query) {
        let mut flight = self.asked.pop_front().expect("blocks that were asked for");
        let [a, b] = ["take_a", "take_b"].map(|port| self.entity.get(port));
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let meant = a >> p & 1 == 1 && b >> q & 1 == 1;
            flight.survive |= u64::from(meant && overlap(query.seed, flight.blocks, [p, q])) << (2 * p + q);
        }
        flight.due = self.clock + 8;
        self.tested.push_back(flight);
    }

    fn step(&mut self, query: &Query, in_flight: u32) -> Outcome {
        let answer = self.tested.front().filter(|flight| flight.due <= self.clock);
        let (valid, survive) = (answer.is_some(), answer.map_or(0xf, |flight| flight.survive));
        if valid {
            self.tested.pop_front();
        }
        self.entity.set("survive_valid", valid.into());
        self.entity.set("survive", survive);
        let (ready, pair_ready) = (!seldom(&mut self.rng, 4), !seldom(&mut self.rng, 3));
        self.entity.set("request_ready", ready.into());
        self.entity.set("pair_ready", pair_ready.into());
        self.entity.set("ending", self.ended.is_some().into());
        let taken = self.blocks(query);
        self.entity.settle();
        if taken {
            self.take(query);
        }
        let asks = self.entity.is("request_valid") && ready;
        expect(self.entity.is("expanded") == asks, self.clock, "expanded")?;
        if asks {
            expect(self.ended.is_none(), self.clock, "a pair is popped at the end")?;
            self.found.expansions += 1;
            let blocks = ["request_a", "request_b"].map(|port| self.entity.get(port) as u32);
            let known = (0..2).all(|i| (blocks[i] as usize) < query.trees[i].blocks.len());
            expect(known, self.clock, "a block that there is not")?;
            let due = self.clock + self.rng.random_range(2..12);
            self.asked.push_back(Flight { blocks, due, survive: 0 });
            expect(self.asked.len() + self.tested.len() <= in_flight as usize, self.clock, "too many in flight")?;
        }
        if self.entity.is("pair_valid") && pair_ready {
            expect(self.ended.is_none_or(|clocks| clocks == 0), self.clock, "a pair of leaves at the end")?;
            self.found.pairs.push(["pair_a", "pair_b"].map(|port| self.entity.get(port)));
        }
        self.found.tests += self.entity.get("tested");
        self.found.survivors += self.entity.get("survived");
        self.bad |= self.entity.is("bad_tree");
        self.limited |= self.entity.is("limit_reached");
        // Control has a reason a clock later.
        self.ended = self.ended.map(|clocks| clocks + 1).or((self.bad || self.limited).then_some(0));
        Ok(())
    }

    /// A query, from start to idle.
    fn run(&mut self, query: &Query, limit: u32, stack: u64, in_flight: u32) -> Outcome {
        self.found = Found::default();
        (self.ended, self.bad, self.limited) = (None, false, false);
        for (port, value) in [
            ("most_expansions", limit),
            ("block_count_a", query.trees[0].blocks.len() as u32),
            ("block_count_b", query.trees[1].blocks.len() as u32),
            ("triangle_count_a", query.trees[0].triangles),
            ("triangle_count_b", query.trees[1].triangles),
        ] {
            self.entity.set(port, value.into());
        }
        self.entity.set("start", 1);
        let end = self.clock + 60_000;
        while self.clock < end {
            self.step(query, in_flight)?;
            let (idle, waiting) = (self.entity.is("idle"), self.entity.is("waiting"));
            expect(!(idle && waiting), self.clock, "idle and waiting")?;
            self.entity.clock();
            self.clock += 1;
            self.entity.set("start", 0);
            if idle {
                expect(self.asked.is_empty() && self.tested.is_empty(), self.clock, "idle with a pair in flight")?;
                // Counts are registered; control reports later.
                self.entity.set("ending", 1);
                self.entity.settle();
                self.found.tests += self.entity.get("tested");
                self.found.survivors += self.entity.get("survived");
                expect(self.entity.get("greatest_stack") <= stack, self.clock, "the stack overflows")?;
                return Ok(());
            }
        }
        Err("never idle".to_owned())
    }
}

fn traverse(entity: &mut Entity) -> Outcome {
    let design = wide();
    let (stack, in_flight) = (design.params.stack.into(), design.params.in_flight);
    let deepest = design.params.tree_height;
    entity.set("ending", 1);
    entity.reset();
    let (layout, found) = (design.format.block(), Found::default());
    let (asked, tested) = (VecDeque::new(), VecDeque::new());
    let rng = random(14);
    let mut around =
        Around { entity, rng, layout, clock: 0, found, asked, tested, ended: None, bad: false, limited: false };
    for round in 0..40 {
        let rng = &mut around.rng;
        let height = 1 + round % 5;
        let mut trees = [Tree::new(rng, height), Tree::new(rng, 5)];
        // Deeper together than an entry of the stack may be.
        let chains = round % 10 == 7;
        if chains {
            trees = [Tree::chain(deepest + 3), Tree::chain(deepest + 3)];
        }
        if !chains && seldom(rng, 2) {
            trees[usize::from(rng.random::<bool>())].damage(rng);
        }
        let query = Query { trees, seed: (!chains).then(|| rng.random()), deepest };
        let due = query.found();
        let limit = if round % 4 == 3 { rng.random_range(1..=1 + due.expansions as u32) } else { 0 };
        around.run(&query, limit, stack, in_flight)?;
        let limited = limit > 0 && due.expansions > u64::from(limit);
        around.found.pairs.sort_unstable();
        let found = &around.found;
        if due.wrong > 0 {
            expect(around.bad || limited, around.clock, "a bad tree is not noticed")?;
        } else if limited {
            expect(around.limited && !around.bad, around.clock, "the limit is not noticed")?;
            expect(found.expansions == u64::from(limit), around.clock, "as many expansions as the limit")?;
        } else {
            expect(!around.bad && !around.limited, around.clock, "a reason where there is none")?;
            expect(*found == due, around.clock, &format!("other counts or pairs: {found:?}; expected {due:?}"))?;
        }
    }
    Ok(())
}

/// An engine with a stack that lets many pairs fly.
fn wide() -> EngineDesign {
    let engine = EngineParams { stack: 100, ..small(Memory::Axi).params };
    EngineDesign::new(&engine, &Params::default()).unwrap()
}

#[test]
fn leaf_pairs_and_counts_are_those_of_a_recursion() {
    let changes = [
        ("finished <= candidate_leaves and is_last;", "finished <= candidate_leaves;"),
        ("\"0100\" when left_over(2) = '1' else", "\"0110\" when left_over(2) = '1' else"),
        ("side_a & not side_a;", "not side_a & side_a;"),
        ("joins_b(1) <= opened_children(59) and opened_children(29) and", "joins_b(1) <="),
        ("there_b <= listed_b and present_b;", "there_b <= listed_b;"),
        ("or (own_is_deepest and not both_leaves)", ""),
        ("(chosen_a(28) and (both_leaves or not chosen_a(29)))", "(chosen_a(28) and not chosen_a(29))"),
        ("is_survivor and is_pair and not ended;", "is_survivor and is_pair;"),
        ("if allowed = 0 then", "if allowed = 1 then"),
        ("survived(1) <= candidate_leaves", "survived(1) <= '0' and candidate_leaves"),
        ("taken_place <= taken_place + 1;", "taken_place <= taken_place;"),
    ];
    tried_with(&wide(), "engine_traverse", &["engine_stack", "engine_children"], &changes, traverse);
}
