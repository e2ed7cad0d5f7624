//! The way to the triangle unit: every pair goes to it, past it or nowhere, once, and what comes out is in order.

use super::*;
use efsat::pair::Verdict;
use std::collections::VecDeque;

/// In place of the unit: it takes a pair every third clock while it has room, and answers with some bits of what it was given.
const UNIT: &str = "
architecture stub of efsat is
  type words is array (0 to 3) of std_logic_vector(78 downto 0);
  signal held : words;
  signal first : unsigned(1 downto 0) := \"00\";
  signal behind : unsigned(1 downto 0) := \"00\";
  signal count : unsigned(2 downto 0) := \"000\";
  signal slot : unsigned(1 downto 0) := \"00\";
  signal own : std_logic_vector(8 downto 0) := (others => '0');
  signal word : std_logic_vector(78 downto 0);
begin
  in_ready <= '1' when slot = 0 and count /= 4 else '0';
  pose_ready <= '1' when slot = 1 else '0';
  out_valid <= '0' when count = 0 else '1';
  word <= held(to_integer(first));
  out_tag <= word(57 downto 0);
  out_separated <= std_logic_vector(resize(unsigned(word(66 downto 58)), out_separated'length));
  out_overlapping <= std_logic_vector(resize(unsigned(word(75 downto 67)), out_overlapping'length));
  out_verdict <= word(77 downto 76);
  out_outside <= word(78);

  play : process (clk)
    variable now : unsigned(2 downto 0);
  begin
    if rising_edge(clk) then
      now := count;
      slot <= slot + 1;
      if slot = 2 then
        slot <= \"00\";
      end if;
      if pose_valid = '1' and slot = 1 then
        own <= pose_m00(8 downto 0);
      end if;
      if in_valid = '1' and slot = 0 and count /= 4 then
        held(to_integer(behind)) <= in_w1_y(0) & in_v0_x(1 downto 0) & in_v2_z(8 downto 0) & (in_w2_z(8 downto 0) xor own) & in_tag;
        behind <= behind + 1;
        now := now + 1;
      end if;
      if count /= 0 and out_ready = '1' then
        first <= first + 1;
        now := now - 1;
      end if;
      count <= now;
      if reset = '1' then
        count <= \"000\";
        first <= \"00\";
        behind <= \"00\";
      end if;
    end if;
  end process play;
end architecture stub;
";

/// x, y and z of three corners.
type Corners = [u32; 9];

/// What is to come out: lane, numbers, verdict, whether it is the last of its packet, whether a number is outside.
#[derive(Debug, PartialEq)]
struct Decided {
    /// None of a packet: it means nothing.
    lane: Option<u64>,
    numbers: u64,
    verdict: u64,
    last: bool,
    outside: bool,
}

/// A pair of triangles: numbers and corners.
struct Pair {
    numbers: [u64; 2],
    corners: [Corners; 2],
    lane: u64,
    /// There is a place for its answer, from some clock on.
    testable: bool,
}

/// A pair of a packet: corners, tag, and whether it is the last.
struct Single {
    corners: [Corners; 2],
    tag: u16,
    last: bool,
}

/// What runs: a query in a lane, with or without triangle tests, or packets.
#[derive(Clone, Copy, Default)]
struct Phase {
    running: bool,
    lane: u64,
    leaves: bool,
    drops: bool,
    /// Pairs still to come, and clocks before the first.
    left: u32,
    wait: u32,
}

/// What a clock says of the next.
#[derive(Clone, Copy, Default)]
struct Before {
    /// What becomes of the triangles that are there: they are offered to the unit already, dropped, pass by it, or are offered next.
    offered: bool,
    drops: bool,
    passes: bool,
    tests: bool,
}

fn corners(rng: &mut ChaCha8Rng) -> [Corners; 2] {
    [0; 2].map(|_| [0; 9].map(|_| rng.random()))
}

/// Puts numbers of 32 bits from a place on, which is a multiple of 32.
fn put(words: &mut [u64], at: usize, numbers: &[u32]) {
    for (i, &number) in (at / 32..).zip(numbers) {
        words[i / 2] |= u64::from(number) << (32 * (i % 2));
    }
}

/// What the stub finds: verdict, flags of so many bits each, outside.
fn found([v, w]: &[Corners; 2], own: u32, bits: usize) -> (u64, u64, bool) {
    let flags = u64::from(v[8] & 0x1ff) << bits | u64::from((w[8] ^ own) & 0x1ff);
    (u64::from(v[0] & 3), flags, w[4] & 1 == 1)
}

fn drive(entity: &mut Entity, pair: Option<&Pair>, single: Option<&Single>, pose: Option<u32>) {
    if let Some(pair) = pair {
        for (port, i) in [("triangle_a", 0), ("triangle_b", 1)] {
            let mut words = vec![0; 5];
            // The bits above the number mean nothing.
            put(&mut words, 0, &[pair.numbers[i] as u32 | 0xf000_0000]);
            put(&mut words, 32, &pair.corners[i]);
            entity.set_words(port, &words);
        }
    }
    let mut words = vec![0; 22];
    if let Some(Single { corners: [v, w], tag, .. }) = single {
        put(&mut words, 800, &[u32::from(*tag) | 0xffff_0000]);
        put(&mut words, 832, v);
        put(&mut words, 1120, w);
    }
    entity.set_words("job_words", &words);
    let mut words = vec![0; 7];
    put(&mut words, 64, &[pose.unwrap_or(0)]);
    entity.set_words("pose", &words);
    for (port, value) in [
        ("triangles_valid", pair.is_some()),
        ("testable", pair.is_some_and(|pair| pair.testable)),
        ("packet_valid", single.is_some()),
        ("packet_last", single.is_some_and(|single| single.last)),
        ("pose_valid", pose.is_some()),
    ] {
        entity.set(port, value.into());
    }
}

fn triangles(entity: &mut Entity, flag_bits: usize) -> Outcome {
    let mut rng = random(17);
    let mut due: VecDeque<Decided> = VecDeque::new();
    let (mut pair, mut single, mut pose): (Option<Pair>, Option<Single>, Option<u32>) = (None, None, None);
    let (mut phase, mut before, mut own) = (Phase::default(), Before::default(), 0);
    // Clocks without anything, and without an event.
    let (mut quiet, mut still) = (0, 0);
    let [mut tested, mut passed, mut dropped, mut singles] = [0; 4];
    entity.reset();
    for clock in 0..5000 {
        // The next phase begins long after what comes from the one before it.
        if quiet > 6 && phase.left == 0 {
            let running = !seldom(&mut rng, 3);
            let (lane, left) = (rng.random_range(0..4), rng.random_range(1..12));
            phase = Phase { running, lane, leaves: running && seldom(&mut rng, 2), drops: false, left, wait: 6 };
        }
        phase.wait = phase.wait.saturating_sub(1);
        phase.drops |= phase.running && seldom(&mut rng, 60);
        if phase.left > 0 && phase.wait == 0 && pair.is_none() && single.is_none() && !seldom(&mut rng, 3) {
            phase.left -= 1;
            let corners = corners(&mut rng);
            if phase.running {
                let numbers = [0; 2].map(|_| rng.random_range(0..1 << 28));
                let lane = if phase.leaves { phase.lane } else { rng.random_range(0..4) };
                pair = Some(Pair { numbers, corners, lane, testable: false });
            } else {
                single = Some(Single { corners, tag: rng.random(), last: rng.random() });
            }
        }
        if let Some(pair) = &mut pair {
            pair.testable |= seldom(&mut rng, 2);
        }
        if pose.is_none() && seldom(&mut rng, 30) {
            pose = Some(rng.random());
        }
        let (reset, ready) = (seldom(&mut rng, 100), !seldom(&mut rng, 3));
        drive(entity, pair.as_ref(), single.as_ref(), pose);
        for (port, value) in [
            ("reset", reset),
            ("running", phase.running),
            ("leaves_only", phase.leaves),
            ("drops", phase.drops),
            ("decided_ready", ready),
        ] {
            entity.set(port, value.into());
        }
        // Pairs of another lane than the front's are in the unit while its pose is waited for.
        entity.set("front", if phase.leaves { phase.lane } else { rng.random_range(0..4) });
        entity.set("triangles_lane", pair.as_ref().map_or(phase.lane, |pair| pair.lane));
        entity.settle();

        // That a pair has gone is told a clock later.
        let taken = entity.is("triangles_taken");
        expect(!taken || before.offered || before.drops || before.passes, clock, "a pair goes nowhere")?;
        expect(taken || !(before.drops || before.passes), clock, "a pair is dropped or passes at once")?;
        let offered = if before.offered { !taken } else { before.tests };
        let there = pair.is_some() && !taken;
        expect(entity.is("triangles_there") == (there && !offered), clock, "triangles_there")?;
        let testable = pair.as_ref().is_some_and(|pair| pair.testable);
        if taken {
            let Some(Pair { numbers: [a, b], corners, lane, .. }) = pair.take() else {
                return Err(format!("clock {clock}: a pair is taken that there is not"));
            };
            let (lane, numbers) = (Some(lane), b << 28 | a);
            if before.offered {
                let (verdict, ..) = found(&corners, own, flag_bits);
                due.push_back(Decided { lane, numbers, verdict, last: false, outside: false });
                tested += 1;
            } else if before.passes {
                due.push_back(Decided {
                    lane,
                    numbers,
                    verdict: Verdict::PossiblyIncorrect as u64,
                    last: false,
                    outside: false,
                });
                passed += 1;
            } else {
                dropped += 1;
            }
        }

        let decided = entity.is("decided_valid").then(|| Decided {
            lane: phase.running.then(|| entity.get("decided_lane")),
            numbers: entity.get("decided_numbers"),
            verdict: entity.get("verdict"),
            last: entity.is("decided_last"),
            outside: entity.is("decided_outside"),
        });
        if decided.is_some() {
            expect(due.front() == decided.as_ref(), clock, &format!("{decided:?}, due: {:?}", due.front()))?;
        }
        if ready && decided.is_some() {
            due.pop_front();
        }
        before = Before {
            offered,
            drops: there && !offered && phase.drops,
            passes: there && !offered && !phase.drops && testable && phase.leaves && decided.is_none(),
            tests: there && !phase.drops && testable && !phase.leaves,
        };
        let (single_taken, pose_taken) = (entity.is("packet_taken"), pose.is_some() && entity.is("pose_ready"));
        entity.clock();

        still = if taken || single_taken || decided.is_some() { 0 } else { still + 1 };
        quiet = if pair.is_some() || single.is_some() || !due.is_empty() { 0 } else { quiet + 1 };
        expect(quiet > 0 || still < 100, clock, "nothing goes on")?;
        if single_taken {
            let Some(Single { corners, tag, last }) = single.take() else {
                return Err(format!("clock {clock}: a pair of a packet from nowhere"));
            };
            let (verdict, flags, outside) = found(&corners, own, flag_bits);
            due.push_back(Decided { lane: None, numbers: flags << 16 | u64::from(tag), verdict, last, outside });
            singles += 1;
        }
        if pose_taken {
            own = pose.take().unwrap_or_default();
        }
        if reset {
            (pair, single, before) = (None, None, Before::default());
            due.clear();
        }
    }
    expect([tested, passed, dropped, singles].into_iter().all(|count| count > 50), 0, "too little of a kind")
}

#[test]
fn every_pair_goes_to_the_unit_or_past_it_or_nowhere() {
    let changes = [
        ("triangles_there <= there and not offered;", "triangles_there <= there;"),
        ("triangles_go <= unit_ready when offered = '1' else there and", "triangles_go <= there and"),
        (
            "tests_them <= there and testable and not leaves_only and not drops;",
            "tests_them <= there and testable and not leaves_only;",
        ),
        (
            "tests_them <= there and testable and not leaves_only and not drops;",
            "tests_them <= there and not leaves_only and not drops;",
        ),
        (
            "passes_them <= there and testable and leaves_only and not drops;",
            "passes_them <= there and leaves_only and not drops;",
        ),
        (
            "passes_them <= there and testable and leaves_only and not drops;",
            "passes_them <= there and testable and leaves_only;",
        ),
        ("bypass_free <= not bypassed_valid;", "bypass_free <= '1';"),
        ("offered <= not (unit_ready or reset);", "offered <= '0';"),
        ("offered <= tests_them and not reset;", "offered <= tests_them;"),
        ("taken <= triangles_go and not reset;", "taken <= triangles_go;"),
        ("there <= triangles_valid and not taken;", "there <= triangles_valid;"),
        ("elsif decided_ready = '1' then", "else"),
        ("decided_last <= tested_numbers(tag_last) and not of_queries;", "decided_last <= tested_numbers(tag_last);"),
        ("decided_outside <= tested_outside and not of_queries;", "decided_outside <= tested_outside;"),
        (
            "decided_lane <= front when leaves_only = '1' else tested_tag(lane_bits + 55 downto 56);",
            "decided_lane <= front;",
        ),
        ("unit_v <= triangle_a(", "unit_v <= triangle_b("),
        ("of_queries <= running;", "of_queries <= '1';"),
        ("packet_last & job_words(job_pair_tag)", "'1' & job_words(job_pair_tag)"),
        ("triangles_lane & numbers(55 downto", "front & numbers(55 downto"),
    ];
    let design = small(Memory::Axi);
    let unit = text_of(&design, "efsat");
    let (_, ports) = unit.split_once("\nentity efsat is\n").unwrap();
    let (ports, _) = ports.split_once("\nend entity efsat;\n").unwrap();
    let flags = ports.split_once("out_separated").and_then(|(_, rest)| rest.split_once('(')?.1.split_once(' '));
    let flag_bits = flags.unwrap().0.parse::<usize>().unwrap() + 1;
    let context = "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\n";
    let unit = format!("{context}\nentity efsat is\n{ports}\nend entity efsat;\n{UNIT}");
    tried_beside(&design, "engine_triangles", &unit, &changes, |entity| triangles(entity, flag_bits));
}
