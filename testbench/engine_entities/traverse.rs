//! The traversals of random trees, several at a time, against recursive ones: the same leaf pairs and counts, whatever the order
//! of both.

use super::*;
use crate::extent::full;
use efsat::engine::words::{BlockLayout, LEAF_BIT, NO_CHILD};
use std::collections::VecDeque;

/// Both children of a block: links as a block has them.
type Links = [u32; 2];

/// A tree: its blocks, and triangles up to a count.
struct Tree {
    blocks: Vec<Links>,
    triangles: u32,
    /// A block that has another tag.
    spoiled: Option<u32>,
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
        let mut tree = Self { blocks: vec![], triangles: 0, spoiled: None };
        tree.node(rng, height);
        tree
    }

    /// A chain of blocks, each with the next one and a leaf.
    fn chain(height: u32) -> Self {
        let leaf = |number| 1 << LEAF_BIT | number;
        let link = |block| [if block + 1 < height { block + 1 } else { leaf(height) }, leaf(block)];
        Self { blocks: (0..height).map(link).collect(), triangles: height + 1, spoiled: None }
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
        let tag = u128::from(layout.tag ^ u32::from(self.spoiled == Some(block))) << (layout.tag_at % 64);
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
        found.wrong +=
            [a, b].iter().zip(&self.trees).filter(|(node, tree)| tree.spoiled == Some(node.0)).count() as u64;
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

/// A pair in flight: its lane, its blocks, and from when on they, and then the answer, are there.
struct Flight {
    lane: usize,
    blocks: [u32; 2],
    due: usize,
    survive: u64,
}

/// A query at work.
struct Run {
    query: Query,
    limit: u32,
    /// What a recursion comes to, and what came until now.
    due: Found,
    found: Found,
    /// Leaf pairs in the queue of the lane.
    queued: u32,
    /// Clocks since the query has a reason to end.
    ended: Option<usize>,
    bad: bool,
    limited: bool,
    /// Clocks since its start, and that in which the host stops it.
    age: u32,
    stop_at: Option<u32>,
    /// A clock ago it was bad, limited or stopped.
    noticed: bool,
    /// Clocks since it was idle: counts are registered.
    idle: u32,
}

impl Run {
    fn stopped(&self) -> bool {
        self.stop_at.is_some_and(|clock| self.age >= clock)
    }
}

struct Around<'a> {
    entity: &'a mut Entity,
    rng: ChaCha8Rng,
    design: EngineDesign,
    clock: usize,
    /// The query of each lane, and which lane is the oldest.
    lanes: Vec<Option<Run>>,
    oldest: usize,
    asked: VecDeque<Flight>,
    tested: VecDeque<Flight>,
    /// Popped, and not taken by the volume unit.
    without_blocks: u32,
    /// The lane of the blocks of the clock before.
    listed: usize,
    /// Blocks were taken a clock ago: a volume unit of several clocks takes none then.
    rests: bool,
    /// What a pop saw that is told now: the oldest lane, pairs without blocks, and for each lane the pairs that wait in its queue and fly.
    before: (usize, u32, Vec<[u32; 2]>),
}

impl Around<'_> {
    /// Blocks that are there and taken by the volume unit, if there are such.
    fn blocks(&mut self) -> bool {
        // For a while it takes few.
        let takes =
            if (self.clock / 256).is_multiple_of(2) { !seldom(&mut self.rng, 3) } else { seldom(&mut self.rng, 4) };
        let taken = self.asked.front().is_some_and(|flight| flight.due <= self.clock) && takes && !self.rests;
        self.rests = taken && self.design.params.expansion_clocks > 2;
        self.entity.set("blocks_taken", taken.into());
        for (i, port) in ["block_a", "block_b"].into_iter().enumerate() {
            // What is not taken means nothing.
            let noise = [self.rng.random(); 8].to_vec();
            let flight = self.asked.front().filter(|_| taken);
            let words = flight.map_or(noise, |flight| {
                let run = self.lanes[flight.lane].as_ref().expect("a query in flight");
                run.query.trees[i].words(flight.blocks[i], &self.design.format.block())
            });
            self.entity.set_words(port, &words);
        }
        taken
    }

    /// The volume unit answers what it has taken: of children that are not meant that they do not overlap, of those that are
    /// not there anything.
    fn take(&mut self) -> Outcome {
        let mut flight = self.asked.pop_front().expect("blocks that were asked for");
        expect(self.entity.get("take_lane") == flight.lane as u64, self.clock, "blocks of another lane")?;
        let seed = self.lanes[flight.lane].as_ref().expect("a query in flight").query.seed;
        let [a, b] = ["take_a", "take_b"].map(|port| self.entity.get(port));
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let meant = a >> p & 1 == 1 && b >> q & 1 == 1;
            flight.survive |= u64::from(meant && overlap(seed, flight.blocks, [p, q])) << (2 * p + q);
        }
        flight.due = self.clock + 8;
        self.tested.push_back(flight);
        self.without_blocks -= 1;
        Ok(())
    }

    /// The query of the lane that a port names, if the port has something to say.
    fn lane(&self, port: &str) -> Result<usize, String> {
        let lane = self.entity.get(port) as usize;
        expect(self.lanes[lane].is_some(), self.clock, &format!("{port}: a lane without a query"))?;
        Ok(lane)
    }

    fn run(&mut self, lane: usize) -> &mut Run {
        self.lanes[lane].as_mut().expect("a query in flight")
    }

    /// The counts of the trees whose links are read: of the blocks of the clock before.
    fn counts(&mut self) {
        let Some(run) = &self.lanes[self.listed] else { return };
        for (port, value) in [
            ("block_count_a", run.query.trees[0].blocks.len() as u32),
            ("block_count_b", run.query.trees[1].blocks.len() as u32),
            ("triangle_count_a", run.query.trees[0].triangles),
            ("triangle_count_b", run.query.trees[1].triangles),
        ] {
            self.entity.set(port, value.into());
        }
    }

    fn step(&mut self) -> Outcome {
        let params = self.design.params.clone();
        let answer = self.tested.front().filter(|flight| flight.due <= self.clock);
        let (valid, survive) = (answer.is_some(), answer.map_or(0xf, |flight| flight.survive));
        if valid {
            self.tested.pop_front();
        }
        self.entity.set("survive_valid", valid.into());
        self.entity.set("survive", survive);
        let ready = !seldom(&mut self.rng, 4);
        self.entity.set("request_ready", ready.into());
        let ends = |run: &Option<Run>| run.as_ref().is_none_or(|run| run.ended.is_some());
        let ending: u64 = (0..).zip(&self.lanes).map(|(lane, run)| u64::from(ends(run)) << lane).sum();
        self.entity.set("ending", ending);
        self.entity.set("oldest", self.oldest as u64);
        // Pairs of the oldest query alone leave their queue, or are dropped there. Their queue is empty for a while, and then full.
        let rate = [1, 6, 40, 6][self.clock / 64 % 4];
        let mut left = 0;
        for (lane, run) in self.lanes.iter_mut().enumerate() {
            let Some(run) = run else { continue };
            if run.ended.is_some() {
                run.queued = 0;
            } else if lane == self.oldest && run.queued > 0 && seldom(&mut self.rng, rate) {
                run.queued -= 1;
                left = 1 << lane;
            }
        }
        self.entity.set("pair_left", left);
        let taken = self.blocks();
        self.counts();
        self.entity.settle();
        self.listed = self.entity.get("take_lane") as usize;
        // While the queue of the oldest query is full no pair comes into any.
        let pair_ready = self.lanes[self.oldest].as_ref().is_none_or(|run| run.queued < params.pair_queue);
        self.entity.set("pair_ready", pair_ready.into());
        self.entity.settle();
        let popped = if self.entity.is("expanded") { Some(self.lane("expanded_lane")?) } else { None };
        if let Some(lane) = popped {
            let (oldest, without_blocks, [queued, flying]) = (self.before.0, self.before.1, self.before.2[lane]);
            // Told a clock later, and popped in the first clock of the end at the latest.
            let pops_on = self.run(lane).ended.is_some_and(|clocks| clocks > 1);
            expect(!pops_on, self.clock, "a pair is popped at the end")?;
            let crowd = 8u32.div_ceil(params.expansion_clocks) + 1;
            // Three may be chosen before it is known, of a pop every other clock two.
            let late = if params.expansion_clocks > 2 { 2 } else { 3 };
            let free = lane == oldest || without_blocks < crowd + late;
            expect(free, self.clock, "a younger query in front of the oldest")?;
            let room = lane == oldest || queued + 4 * (flying + 1) < params.pair_queue;
            expect(room, self.clock, "a younger query that may fill its queue")?;
            self.run(lane).found.expansions += 1;
            self.without_blocks += 1;
        }
        let flying: Vec<usize> = self.asked.iter().chain(&self.tested).map(|flight| flight.lane).collect();
        let flies = |lane| flying.iter().filter(|&&other| other == lane).count() as u32;
        let of_lanes = self.lanes.iter().enumerate();
        let lanes = of_lanes.map(|(lane, run)| [run.as_ref().map_or(0, |run| run.queued), flies(lane)]).collect();
        self.before = (self.oldest, self.without_blocks, lanes);
        if self.entity.is("request_valid") && ready {
            let lane = self.lane("request_lane")?;
            let blocks = ["request_a", "request_b"].map(|port| self.entity.get(port) as u32);
            let trees = &self.run(lane).query.trees;
            let known = (0..2).all(|i| (blocks[i] as usize) < trees[i].blocks.len());
            expect(known, self.clock, "a block that there is not")?;
            let due = self.clock + self.rng.random_range(2..12);
            self.asked.push_back(Flight { lane, blocks, due, survive: 0 });
            let flying = self.asked.len() + self.tested.len();
            expect(flying <= params.in_flight as usize, self.clock, "too many in flight")?;
        }
        if taken {
            self.take()?;
        }
        if self.entity.is("pair_valid") {
            let lane = self.lane("pair_lane")?;
            if pair_ready {
                let pair = ["pair_a", "pair_b"].map(|port| self.entity.get(port));
                let run = self.run(lane);
                // Looked at when it comes: few queries come to their end undisturbed.
                let own = run.due.pairs.contains(&pair);
                let late = run.ended.is_some_and(|clocks| clocks > 0);
                run.queued += 1;
                run.found.pairs.push(pair);
                let filled = run.queued >= params.pair_queue;
                expect(own, self.clock, "a pair of leaves of another query")?;
                expect(!late, self.clock, "a pair of leaves at the end")?;
                expect(!filled || lane == self.oldest, self.clock, "a younger query fills its queue")?;
            }
        }
        let of_lane = |port: &str, lane: usize| self.entity.get(port) >> lane & 1 == 1;
        let counted = [("tested", "tested_lane"), ("survived", "survived_lane")]
            .map(|(port, lane)| (self.entity.get(port), self.entity.get(lane) as usize));
        let found: Vec<[bool; 3]> = (0..self.lanes.len())
            .map(|lane| ["bad_tree", "limit_reached", "idle"].map(|port| of_lane(port, lane)))
            .collect();
        for (lane, ([bad, limited, idle], run)) in found.into_iter().zip(&mut self.lanes).enumerate() {
            let works = popped == Some(lane) || flying.contains(&lane);
            expect(!(idle && works), self.clock, "idle with a pair in flight")?;
            let Some(run) = run else {
                let none = counted.iter().all(|&(count, of)| count == 0 || of != lane);
                expect(none, self.clock, "counts of what is forgotten")?;
                continue;
            };
            let [(tests, of_tests), (survivors, of_survivors)] = counted;
            run.found.tests += if of_tests == lane { tests } else { 0 };
            run.found.survivors += if of_survivors == lane { survivors } else { 0 };
            run.bad |= bad;
            run.limited |= limited;
            run.idle = if idle { run.idle + 1 } else { 0 };
            // Control finds a reason in one clock and has it in the next.
            run.ended = run.ended.map(|clocks| clocks + 1).or(run.noticed.then_some(0));
            run.age += 1;
            run.noticed = run.bad || run.limited || run.stopped();
        }
        self.entity.clock();
        self.clock += 1;
        Ok(())
    }

    /// A clock of reset: all is forgotten, and what was popped, taken or answered in the clocks before is not counted any more.
    fn forget(&mut self) {
        self.entity.set("reset", 1);
        self.entity.set("start", 0);
        let may_take = !self.rests && !self.asked.is_empty();
        self.entity.set("blocks_taken", u64::from(may_take && seldom(&mut self.rng, 2)));
        self.entity.set("survive_valid", u64::from(!self.tested.is_empty() && seldom(&mut self.rng, 2)));
        self.entity.settle();
        self.entity.clock();
        self.entity.set("reset", 0);
        self.clock += 1;
        self.lanes.fill_with(|| None);
        self.asked.clear();
        self.tested.clear();
        (self.without_blocks, self.rests) = (0, false);
    }

    /// A clock in which a query may start, the one of this round. Returns whether it does.
    fn goes_on(&mut self, round: Option<u32>, most: usize) -> Result<bool, String> {
        let active = self.lanes.iter().flatten().count();
        let lane = (self.oldest + active) % self.lanes.len();
        let starts = round.filter(|_| active < most && seldom(&mut self.rng, 20));
        if let Some(round) = starts {
            let (query, due, limit) = query(&mut self.rng, round, self.design.params.tree_height);
            let run = Run {
                query,
                limit,
                due,
                found: Found::default(),
                queued: 0,
                ended: None,
                bad: false,
                limited: false,
                age: 0,
                stop_at: (round % 10 == 4).then(|| self.rng.random_range(1..12)),
                noticed: false,
                idle: 0,
            };
            self.lanes[lane] = Some(run);
            self.entity.set("most_expansions", limit.into());
            self.entity.set("start_lane", lane as u64);
        }
        self.entity.set("start", starts.is_some().into());
        self.step()?;
        Ok(starts.is_some())
    }

    /// What the oldest query came to, if it is done. Returns whether it is.
    fn finish(&mut self) -> Result<bool, String> {
        if self.lanes[self.oldest].as_ref().is_none_or(|run| run.idle <= 3 || run.queued > 0) {
            return Ok(false);
        }
        let flies = |flight: &Flight| flight.lane == self.oldest;
        let some_flies = self.asked.iter().any(flies) || self.tested.iter().any(flies);
        expect(!some_flies, self.clock, "idle with a pair in flight")?;
        let stack = self.entity.get("greatest_stack");
        expect(stack <= self.design.params.stack.into(), self.clock, "the stack overflows")?;
        let run = self.lanes[self.oldest].take().expect("a query");
        self.oldest = (self.oldest + 1) % self.lanes.len();
        if run.stopped() {
            return Ok(true);
        }
        let Run { limit, due, mut found, bad, limited, .. } = run;
        let limits = limit > 0 && due.expansions > u64::from(limit);
        found.pairs.sort_unstable();
        if due.wrong > 0 {
            expect(bad || limits, self.clock, "a bad tree is not noticed")?;
        } else if limits {
            expect(limited && !bad, self.clock, "the limit is not noticed")?;
            expect(found.expansions == u64::from(limit), self.clock, "as many expansions as the limit")?;
        } else {
            expect(!bad && !limited, self.clock, "a reason where there is none")?;
            expect(found == due, self.clock, &format!("other counts or pairs: {found:?}; expected {due:?}"))?;
        }
        Ok(true)
    }
}

/// A query, what it comes to, and how many expansions it may take.
fn query(rng: &mut ChaCha8Rng, round: u32, deepest: u32) -> (Query, Found, u32) {
    let height = 1 + round % 5;
    let mut trees = [Tree::new(rng, height), Tree::new(rng, 5)];
    // Deeper together than an entry of the stack may be.
    let chains = round % 10 == 7;
    if chains {
        trees = [Tree::chain(deepest + 3), Tree::chain(deepest + 3)];
    }
    let side = usize::from(rng.random::<bool>());
    match rng.random_range(0..4) {
        0 | 1 if !chains => trees[side].damage(rng),
        2 if !chains => trees[side].spoiled = Some(rng.random_range(0..trees[side].blocks.len() as u32)),
        _ => {}
    }
    // In some everything overlaps, too.
    let query = Query { trees, seed: (!chains && round % 10 != 5).then(|| rng.random()), deepest };
    let found = query.found();
    let limit = if matches!(round % 4, 1 | 2) { rng.random_range(1..=1 + found.expansions as u32) } else { 0 };
    (query, found, limit)
}

/// So many queries in flight at most.
fn traverse(entity: &mut Entity, design: EngineDesign, most: usize) -> Outcome {
    let lanes = design.params.queries as usize;
    entity.set("ending", (1 << lanes) - 1);
    entity.reset();
    let mut around = Around {
        entity,
        rng: random(15),
        design,
        clock: 0,
        lanes: (0..lanes).map(|_| None).collect(),
        oldest: 0,
        asked: VecDeque::new(),
        tested: VecDeque::new(),
        without_blocks: 0,
        listed: 0,
        rests: false,
        before: (0, 0, vec![[0; 2]; lanes]),
    };
    let rounds = if full() { 160 } else { 60 };
    let (mut round, mut finished) = (0, 0);
    while round < rounds || around.lanes.iter().any(Option::is_some) {
        expect(around.clock < finished + 20_000, around.clock, "never idle")?;
        let due = (round < rounds).then_some(round);
        round += u32::from(around.goes_on(due, most)?);
        if around.finish()? {
            finished = around.clock;
        }
    }
    // Then all is forgotten over and over.
    for clock in 0..if full() { 6000 } else { 2000 } {
        let busy = !(around.asked.is_empty() && around.tested.is_empty());
        if busy && seldom(&mut around.rng, 50) {
            around.forget();
            // As soon as control could start one again.
            for _ in 0..4 {
                around.goes_on(None, most)?;
            }
        }
        around.goes_on(Some(clock), most)?;
        around.finish()?;
    }
    Ok(())
}

/// An engine with a stack that lets many pairs fly.
/// That with eight queries takes blocks in two clocks one behind the other, the others do not.
fn wide(queries: u32, in_flight: u32) -> EngineDesign {
    let expansion_clocks = if queries == 8 { 2 } else { 4 };
    let engine = EngineParams { stack: 100, queries, in_flight, expansion_clocks, ..small(Memory::Axi).params };
    EngineDesign::new(&engine, &Params::default()).unwrap()
}

#[test]
fn leaf_pairs_and_counts_are_those_of_a_recursion() {
    let changes = [
        ("nodes_finished <= candidate and is_last;", "nodes_finished <= candidate;"),
        ("\"0100\" when left_over(2) = '1' else", "\"0110\" when left_over(2) = '1' else"),
        ("side_a & not side_a;", "not side_a & side_a;"),
        ("next_joins_b := joins(next_leaf(1 downto 0),", "next_joins_b := joins(\"11\","),
        ("there_b <= listed_b and present_b;", "there_b <= listed_b;"),
        ("or found_deepest))", "))"),
        ("(found_leaves(k) and (found_fault_a(a) or found_fault_b(b)))", "(found_leaves(k) and found_fault_b(b))"),
        ("pair_due <= some_leaves and not leaves_ended;", "pair_due <= some_leaves;"),
        ("if allowed = 1 then", "if allowed = 2 then"),
        ("+ unsigned(met_survivors(3 downto 3))", ""),
        // A record is lost, or overtaken.
        ("(nodes_wait = '1' or last_pick = '0')", "last_pick = '0'"),
        ("return of_b(0);", "return of_a(0);"),
        (
            "next_leaves <= leaf_memory(to_integer(leaf_read)) when leaves_wait = '1'",
            "next_leaves <= leaf_memory(to_integer(leaf_read)) when brings_leaves = '0'",
        ),
        ("taken_place <= taken_place + 1;", "taken_place <= taken_place;"),
        // Lanes are mixed up.
        ("expanded_lane <= std_logic_vector(issued_lane);", "expanded_lane <= std_logic_vector(chosen_lane);"),
        ("own_lane <= next_node_lane;", "own_lane <= met_lane;"),
        ("leaf_lane <= next_leaf_lane;", "leaf_lane <= met_lane;"),
        ("told_lane <= there_lane;", "told_lane <= listed_lane;"),
        ("(bad_a or bad_b) = '1' and told_lane = lane", "(bad_a or bad_b) = '1' and there_lane = lane"),
        // Behind a reset counts go on.
        ("        popped_one <= '0';\n", ""),
        ("        there_a <= \"00\";\n        there_b <= \"00\";\n        tested", "        tested"),
        ("        tested <= \"000\";", ""),
        ("if (met and not reset) = '1' then", "if met = '1' then"),
        // At the end pairs are popped, or it comes in front of one that flies.
        ("lives <= chosen and not ended;", "lives <= chosen;"),
        ("(ending and ended) or not", "ending or not"),
        // Right behind a pop: an entry that there is not, and an expansion more than the limit.
        ("lives and many and", "lives and filled and"),
        ("many and not few_left and", "many and"),
        // A younger query takes more than the queue of its leaf pairs has room for, or goes in front of the oldest.
        ("(pairs_freed - 4)", "pairs_freed"),
        ("to_unsigned(pairs - 8, ", "to_unsigned(pairs + 8, "),
        ("or not (pair_room(pair_room_bits - 1) or crowded));", "or not crowded);"),
        ("or not (pair_room(pair_room_bits - 1) or crowded));", "or not pair_room(pair_room_bits - 1));"),
    ];
    // More fly than may.
    let flights = [
        ("and all_but_two_fly)", "and all_fly)"),
        ("((some_chosen or popped_one) and all_but_one_fly)", "(some_chosen and all_but_one_fly)"),
        ("((some_chosen or popped_one) and all_but_one_fly)", "(popped_one and all_but_one_fly)"),
    ];
    let all = EngineParams::default().in_flight;
    for (queries, most, in_flight) in share(3, [(8, 4, all), (4, 1, all), (2, 2, all), (8, 4, 4), (4, 4, 3)]) {
        let design = wide(queries, in_flight);
        let changes = match (most, in_flight) {
            // A pop every other clock needs no second flag.
            (4, 3) => &flights[1..],
            (4, 4) => &flights,
            (4, _) => &changes,
            _ => &[],
        };
        let parts =
            ["engine_stack", "engine_lane", "engine_issue", "engine_children", "engine_flight", "engine_survivors"];
        let test = |entity: &mut Entity| traverse(entity, wide(queries, in_flight), most);
        tried_with(&design, "engine_traverse", &parts, changes, test);
    }
}
