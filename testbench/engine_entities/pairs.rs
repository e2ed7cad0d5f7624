//! The queues of leaf pairs: order of queries and pairs, capacity, poses, and what is not answered.

use super::*;
use std::collections::VecDeque;

/// Lanes, and places of a queue.
const LANES: usize = 4;
const PLACES: usize = 16;

/// A query in its lane.
#[derive(Default)]
struct Query {
    /// Accepted and not asked for.
    queue: VecDeque<[u64; 2]>,
    /// Accepted and not told to have left.
    in_queue: i32,
    /// Asked for and not answered or dropped.
    open: u32,
    /// Pairs still to come.
    to_come: u32,
    leaves: bool,
    ending: bool,
    /// A clock ago.
    was_ending: bool,
    /// Whether the unit was given its pose.
    posed: bool,
    /// Clocks since it began, and whether pairs of it were open one and two clocks ago: that it is idle is told a clock later.
    age: u32,
    was_open: [bool; 2],
}

/// Everything around the queues: who sends pairs, the memory of triangles, and the unit.
struct Around {
    lanes: Vec<Option<Query>>,
    oldest: usize,
    /// Asked for and not taken: lane, and the clock in which the triangles come.
    asked: VecDeque<(usize, usize)>,
    /// In the unit, by lane.
    tested: VecDeque<usize>,
    /// The lane whose pose the unit has.
    pose: Option<usize>,
    /// Whether the queue of the oldest query had one place left at most, now and a clock ago.
    filled: [bool; 2],
}

impl Around {
    /// A bit for each lane.
    fn flags(&self, of: impl Fn(&Query) -> bool, without: bool) -> u64 {
        let flag = |query: &Option<Query>| u64::from(query.as_ref().map_or(without, &of));
        (0..).zip(&self.lanes).map(|(lane, query)| flag(query) << lane).sum()
    }

    /// How old the query of a lane is, 0 the oldest.
    fn age(&self, lane: usize) -> usize {
        (lane + LANES - self.oldest) % LANES
    }

    fn query(&mut self, lane: usize) -> &mut Query {
        self.lanes[lane].as_mut().expect("a query")
    }

    fn clock(&mut self, entity: &mut Entity, rng: &mut ChaCha8Rng, clock: usize, rates: [u32; 4]) -> Outcome {
        let [offers, takes, tests, answers] = rates.map(|rate| rate > 0 && seldom(rng, rate));
        let held = self.lanes[self.oldest].as_ref().map_or(0, |query| query.queue.len());
        self.filled = [held >= PLACES - 1, self.filled[0]];
        // A query begins, or has a reason to end.
        let active = self.lanes.iter().flatten().count();
        if active < LANES && seldom(rng, if active == 1 { 4 } else { 40 }) {
            let most = [1, 4, 60, 60][rng.random_range(0..4)];
            let to_come = rng.random_range(0..most);
            let lane = (self.oldest + active) % LANES;
            self.lanes[lane] = Some(Query { to_come, leaves: seldom(rng, 3), ..Query::default() });
        }
        if seldom(rng, 300)
            && let Some(query) = &mut self.lanes[rng.random_range(0..LANES)]
        {
            (query.ending, query.to_come) = (true, 0);
        }
        // A younger query leaves a place in its queue.
        let sends = |lane: &usize| {
            let room = |query: &Query| *lane == self.oldest || query.in_queue < PLACES as i32 - 1;
            self.lanes[*lane].as_ref().is_some_and(|query| query.to_come > 0 && room(query))
        };
        let senders: Vec<usize> = (0..LANES).filter(sends).collect();
        let sender = (!senders.is_empty()).then(|| senders[rng.random_range(0..senders.len())]);
        let lane = sender.unwrap_or(0);
        let pair = [rng.random_range(0..1 << 28), rng.random_range(0..1 << 28)];
        let come = self.asked.front().is_some_and(|&(_, due)| due <= clock);
        let answered = answers && self.tested.front() == Some(&self.oldest);
        for (port, value) in [
            ("oldest", self.oldest as u64),
            ("oldest_flags", 1 << self.oldest),
            ("posed", self.flags(|_| true, false)),
            ("started", self.flags(|_| true, false)),
            ("ending", self.flags(|query| query.ending, true)),
            ("leaves_only", self.flags(|query| query.leaves, false)),
            ("traversed", self.flags(|query| query.to_come == 0, true)),
            ("pair_valid", u64::from(offers && sender.is_some())),
            ("pair_lane", lane as u64),
            ("pair_a", pair[0]),
            ("pair_b", pair[1]),
            ("request_ready", takes.into()),
            ("triangles_valid", come.into()),
            ("pose_ready", u64::from(seldom(rng, 2))),
            ("answered", answered.into()),
            ("retire", 0),
        ] {
            entity.set(port, value);
        }
        entity.set("triangles_taken", 0);
        entity.settle();
        let of_oldest = |&(lane, _): &(usize, usize)| lane == self.oldest;
        let waits = self.asked.iter().any(of_oldest)
            || self.lanes[self.oldest].as_ref().is_some_and(|query| !query.ending && !query.queue.is_empty());
        expect(!waits || entity.is("reads"), clock, "the oldest query waits for triangles")?;
        if answered {
            self.tested.pop_front();
            let oldest = self.oldest;
            self.query(oldest).open -= 1;
        }
        let pose = entity.is("pose_valid");
        if come {
            let (lane, _) = self.asked[0];
            expect(entity.get("triangles_lane") == lane as u64, clock, "triangles of another lane")?;
            let drops = entity.is("drops");
            expect(drops == self.query(lane).was_ending, clock, "drops")?;
            expect(entity.is("testable") == (self.pose == Some(lane)), clock, "a pair under another pose")?;
            if drops || (tests && entity.is("testable")) {
                entity.set("triangles_taken", 1);
                self.asked.pop_front();
                if drops {
                    self.query(lane).open -= 1;
                } else {
                    // Queries without triangle tests are never in the unit together with others.
                    let leaves = self.query(lane).leaves;
                    let alone = self.tested.iter().all(|&other| other == lane)
                        || !(leaves || self.tested.iter().any(|&other| self.lanes[other].as_ref().unwrap().leaves));
                    expect(alone, clock, "queries of both kinds in the unit")?;
                    self.tested.push_back(lane);
                }
            }
        }
        if pose {
            let front = entity.get("front") as usize;
            expect(self.lanes[front].is_some(), clock, "a pose of no query")?;
            let older = self.asked.iter().any(|&(lane, _)| lane != front);
            expect(!older, clock, "a pose in front of pairs of an older query")?;
            if entity.input("pose_ready") {
                self.pose = Some(front);
                self.query(front).posed = true;
            }
        }
        if entity.is("request_valid") && takes {
            let lane = entity.get("front") as usize;
            expect(!self.query(lane).ending, clock, "a request at the end")?;
            let due = self.query(lane).queue.pop_front().ok_or(format!("clock {clock}: a pair from nowhere"))?;
            expect([entity.get("request_a"), entity.get("request_b")] == due, clock, "another pair is due")?;
            let age = self.age(lane);
            let older = self.lanes.iter().enumerate().any(|(other, query)| {
                let waits = |query: &Query| query.to_come > 0 || (!query.queue.is_empty() && !query.ending);
                query.as_ref().is_some_and(waits) && self.age(other) < age
            });
            expect(!older, clock, "a pair in front of those of an older query")?;
            self.query(lane).open += 1;
            self.asked.push_back((lane, clock + rng.random_range(2..20)));
        }
        if let Some(lane) = sender.filter(|_| offers) {
            let held = self.query(lane).queue.len();
            expect(entity.is("pair_ready") || self.filled[1], clock, "a queue that is full too soon")?;
            expect(held <= PLACES + 3, clock, "a queue has 16 places, and three pairs are in front of it")?;
            if entity.is("pair_ready") {
                self.query(lane).queue.push_back(pair);
                self.query(lane).in_queue += 1;
                self.query(lane).to_come -= 1;
            }
        }
        for lane in 0..LANES {
            let idle = entity.get("idle") >> lane & 1 == 1;
            let Some(query) = &mut self.lanes[lane] else { continue };
            query.in_queue -= i32::from(entity.get("pair_left") >> lane & 1 == 1);
            query.was_ending = query.ending;
            if query.ending {
                query.queue.clear();
            }
            expect(!(query.was_open[0] && idle), clock, "idle with open pairs")?;
            query.was_open = [query.was_open[1], query.open > 0 || !query.queue.is_empty()];
            query.age += 1;
        }
        let oldest = self.oldest;
        let done = entity.get("idle") >> oldest & 1 == 1
            && self.lanes[oldest]
                .as_ref()
                .is_some_and(|query| query.age > 1 && query.to_come == 0 && query.open == 0 && query.queue.is_empty());
        if done && !pose {
            let passed =
                (0..LANES).any(|lane| lane != oldest && self.lanes[lane].as_ref().is_some_and(|query| query.posed));
            expect(self.query(oldest).posed || passed, clock, "a query is done before the unit has its pose")?;
            let query = self.query(oldest);
            expect(query.ending || query.in_queue == 0, clock, "pairs that have not left their queue")?;
            entity.set("retire", 1);
            self.lanes[oldest] = None;
            self.oldest = (oldest + 1) % LANES;
        }
        entity.settle();
        entity.clock();
        Ok(())
    }
}

fn pairs(entity: &mut Entity) -> Outcome {
    let mut rng = random(9);
    let lanes = (0..LANES).map(|_| None).collect();
    let (asked, tested) = Default::default();
    let mut around = Around { lanes, oldest: 0, asked, tested, pose: None, filled: [false; 2] };
    entity.set("oldest_flags", 1);
    entity.set("ending", (1 << LANES) - 1);
    entity.set("traversed", (1 << LANES) - 1);
    entity.reset();
    let mut done = 0;
    for clock in 0..32_000 {
        let rates = [[1, 1, 1, 1], [2, 1, 3, 3], [1, 3, 2, 2], [1, 0, 1, 1], [3, 3, 1, 1]][clock / 50 % 5];
        let before = around.oldest;
        around.clock(entity, &mut rng, clock, rates)?;
        done += u32::from(around.oldest != before);
    }
    expect(done > 200, 32_000, "queries that end")?;
    Ok(())
}

#[test]
fn pairs_are_asked_for_in_order_and_counted() {
    let changes = [
        ("waiting(lane) = places - 2 then", "waiting(lane) = places - 3 then"),
        ("waiting(lane) = places - 2 then", "waiting(lane) = places - 1 then"),
        ("waiting(lane) = places - 1 then", "waiting(lane) = places then"),
        ("if waiting(lane) = places - 1 then", "if true then"),
        ("asks <= head_valid and not front_ending;", "asks <= head_valid;"),
        ("request_b <= head(27 downto 0);", "request_b <= head(55 downto 28);"),
        // A pose goes in front of older pairs, or pairs go in front of their pose; kinds of queries are mixed.
        ("and not has_pose and not some_of_last;", "and not has_pose;"),
        ("testable <= some_of_last or has_pose;", "testable <= '1';"),
        (
            "advance_free <= '1' when (some_open or opened) = nobody else",
            "advance_free <= '1' when some_open = some_open else",
        ),
        // The front moves on too soon, not at all with its query, or past the youngest one.
        ("and advance_free and not (held or front_waits)", "and advance_free and not (read_valid or front_waits)"),
        ("and advance_free and not (held or front_waits)", "and advance_free and not held"),
        ("held <= head_valid or next_valid or read_valid;", "held <= head_valid or next_valid;"),
        ("is_front <= rotated(is_front);", "is_front <= is_front;"),
        ("some_of_last <= front_left;", "some_of_last <= '0';"),
        ("if (advances or ends_front) = '1' then", "if advances = '1' then"),
        ("may_advance and not advances and not ends_front;", "may_advance and not ends_front;"),
        ("may_advance and not advances and not ends_front;", "may_advance and not advances;"),
        ("drops_them <= ending(to_integer(next_of)) and not reset;", "drops_them <= front_ending;"),
        ("drops_them <= ending(to_integer(next_of)) and", "drops_them <= ending(to_integer(triangles_of)) and"),
        (
            "answered_one(lane) <= answered and oldest_flags(lane);",
            "answered_one(lane) <= answered and is_front(lane);",
        ),
        // Of the three pairs that are held one is lost, or forgotten when the front moves on.
        ("fetches <= not (next_valid and read_valid);", "fetches <= '1';"),
        ("(front_waits and fetches) or (read_valid and next_valid and not moves);", "front_waits and fetches;"),
        ("if (moves or not next_valid) = '1' then\n        next_valid", "if moves = '1' then\n        next_valid"),
        ("if (moves or not next_valid) = '1' then\n        next_pair", "if moves = '1' then\n        next_pair"),
        ("head_valid <= next_valid or passes;", "head_valid <= next_valid or read_valid or passes;"),
        // A pair passes by one that is older, or is asked for twice.
        ("(unsigned(pair_lane))) and not (held or front_waits)", "(unsigned(pair_lane))) and not held"),
        ("(unsigned(pair_lane))) and not (held or front_waits)", "(unsigned(pair_lane))) and not front_waits"),
        // Pairs come into a queue that is full.
        ("accepts <= pair_valid and not oldest_full;", "accepts <= pair_valid;"),
        // A younger query that has filled its own but for one place stops the oldest, too.
        ("if (full and oldest_flags) /= nobody then", "if full /= nobody then"),
        // The front is taken for that of the oldest query, or not.
        ("if advances = '1' and retire = '0' then", "if advances = '1' and retire = '1' then"),
        ("front_is_oldest = '0' and front_lane = unsigned(oldest) + 1", "front_lane = unsigned(oldest)"),
        ("front_is_oldest = '0' and front_lane = unsigned(oldest) + 1", "front_is_oldest = '0'"),
        ("goes := is_fetched or (comes and may_pass);", "goes := is_fetched;"),
        ("not (some_wait(lane) or held)) = '1';", "not some_wait(lane)) = '1';"),
        ("(is_front(lane) and some_wait(lane) and fetches)", "(is_front(lane) and fetches)"),
        ("if comes and not (is_fetched or may_pass) then", "if comes and not is_fetched then"),
        ("if comes and not (is_fetched or may_pass) then", "if comes and not may_pass then"),
        ("elsif is_fetched and not comes then", "elsif is_fetched then"),
        ("if goes and reset = '0' then", "if goes and not comes and reset = '0' then"),
        // One that was asked for is not counted, or counted twice; nothing waits for it.
        ("asked_one <= asked and not reset;", "asked_one <= asked and not (triangles_taken or reset);"),
        ("if asked_one = '1' and (triangles_taken = '0' or some_of_last = '1') then", "if asked_one = '1' then"),
        ("elsif asked_one = '0' and triangles_taken = '1'", "elsif triangles_taken = '1'"),
        ("(held = '1' or asked_one = '1' or of_front /= 0))", "(held = '1' or of_front /= 0))"),
        ("not some_open(lane) and not opened(lane) and", "not some_open(lane) and"),
    ];
    let design =
        EngineDesign::new(&EngineParams { queries: LANES as u32, ..small(Memory::Axi).params }, &Params::default());
    tried(&design.unwrap(), "engine_pairs", &changes, pairs);
}
