//! The schedules: optimal on small programs, as many registers in the modules as the program says, and on the default
//! design within ten per cent of what a linear solver found (docs/schedule.md).

use crate::extent::share;
use efsat::design::{Design, Probes};
use efsat::netlist::{Control, DelayLine, Driver, Instance, Module, Wire};
use efsat::op::{Add, Comb, Type};
use efsat::params::{Axes, Guard, Params, Projections, Transform};
use efsat::schedule::GROUP;
use efsat::schedule::linear_program::{Event, Held, LinearProgram, Reading, Stream};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Register bits of a module itself, without what only tells phases and slots apart, which no program counts.
fn own_bits(module: &Module) -> u64 {
    let bits = module.parts().flat_map(|part| &part.signals).map(|s| match &s.driver {
        Driver::Register { op: Some(Comb::Lookup(..) | Comb::Equal(..)), .. } => 0,
        Driver::Register { .. } if s.place.base == "strobe" || s.place.base.starts_with("busy_") => 0,
        Driver::Register { .. } => u64::from(s.ty.bits),
        _ => 0,
    });
    bits.sum()
}

/// The table of docs/schedule.md: unit, instances, register bits, optimum with whole captures.
fn recorded() -> Vec<(String, usize, u64, f64)> {
    let text = include_str!("../docs/schedule.md");
    let rows = text.lines().filter(|line| line.starts_with("| `"));
    let rows = rows.map(|line| {
        let cells: Vec<&str> = line.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        (cells[1].to_owned(), cells[2].parse().unwrap(), cells[3].parse().unwrap(), cells[5].parse().unwrap())
    });
    rows.collect()
}

#[test]
fn the_default_design_is_within_ten_per_cent_of_the_optimum() {
    let design = Design::new(&Params::default(), Probes::None).unwrap();
    let schedules = design.schedule.hierarchy();
    let modules: BTreeMap<String, u64> =
        design.top.hierarchy().iter().map(|module| (module.name.clone(), own_bits(module))).collect();
    let ours: Vec<(String, usize, u64)> = schedules
        .iter()
        .map(|(schedule, instances)| (schedule.block.name.clone(), *instances, schedule.register_bits))
        .collect();
    let recorded = recorded();
    let as_recorded: Vec<(String, usize, u64)> = recorded.iter().map(|(u, i, b, _)| (u.clone(), *i, *b)).collect();
    assert_eq!(ours, as_recorded, "run scripts/figures schedule and look at docs/schedule.md");
    // The modules have some more, which no program counts.
    let far: Vec<_> = recorded.iter().filter(|(unit, .., optimum)| modules[unit] as f64 > 1.1 * optimum).collect();
    assert!(far.is_empty(), "{far:?}");
}

#[test]
fn modules_have_the_registers_that_the_program_counts() {
    let mut sets = vec![];
    for (width, frequency) in [(18, 100), (12, 60), (25, 100), (32, 150), (18, 200), (20, 250)] {
        for axes_per_clock in [1, 2, 3, 6, 11] {
            for axes in [Axes::Eleven, Axes::Seventeen] {
                // A device without delay lines with a tap, which take the place of registers that the program counts.
                let device = "lfe5u-85-6".to_owned();
                let params = Params { width, frequency, axes_per_clock, axes, device, ..Params::default() };
                sets.push(Params { transform_width: params.transform_width.max(width), ..params.clone() });
                let device = "xc6slx150-3".to_owned();
                let projections = Projections::Intersect;
                sets.push(Params { renormalise: false, device, projections, ..params.clone() });
                sets.push(Params { transform: Transform::Off, projections: Projections::Skip, ..params });
            }
        }
    }
    // Fifths have all kinds of every axis.
    let sets = share(5, sets);
    let wrong: Vec<String> = sets
        .par_iter()
        .flat_map_iter(|params| {
            let design = Design::new(params, Probes::None).unwrap();
            let modules = design.top.hierarchy();
            let schedules = design.schedule.hierarchy();
            schedules
                .into_iter()
                .filter_map(|(schedule, _)| {
                    let module = modules.iter().find(|m| m.name == schedule.block.name)?;
                    let (own, counted) = (own_bits(module), schedule.register_bits);
                    let name = &schedule.block.name;
                    // Uses of a per-pair value share its captures where they can, and where each reads it through a
                    // whole interval of its own they cannot; no program counts either.
                    let most = if schedule.program.held.is_empty() { counted } else { counted * 3 / 2 };
                    let least = if schedule.program.held.is_empty() { counted } else { counted * 3 / 4 };
                    (own > most || own < least)
                        .then(|| format!("{}: {name}: {own}, counted {counted}", params.command_line()))
                })
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), sets.len(), wrong.join("\n"));
}

#[test]
fn a_choice_that_is_too_long_takes_two_clocks() {
    for (device, fits, divides) in [("xc2v6000-4", 100, 200), ("lfe5u-85-6", 100, 150)] {
        for (frequency, divided) in [(fits, false), (divides, true)] {
            // Behind a guard the operands of these choices have registers of their own.
            let params = Params { device: device.to_owned(), frequency, guard: Guard::LeftOut, ..Params::default() };
            let design = Design::new(&params, Probes::None).unwrap();
            let pipeline = design.top.hierarchy().into_iter().find(|m| m.name == "pair_pipeline").unwrap();
            let signals = pipeline.parts().flat_map(|part| &part.signals);
            let groups: Vec<_> =
                signals.filter(|s| s.name().contains("_group_") && !matches!(s.driver, Driver::Port)).collect();
            assert_eq!(!groups.is_empty(), divided, "{device} at {frequency} MHz");
            let of_lane: Vec<String> =
                groups.iter().map(|s| s.name()).filter(|n| n.starts_with("lane0_z_lo_group")).collect();
            let expected: &[&str] = if divided { &["lane0_z_lo_group_0", "lane0_z_lo_group_1"] } else { &[] };
            assert_eq!(of_lane, expected, "the operands of one multiplexer");
            for signal in groups {
                let Driver::Register { op, args, .. } = &signal.driver else {
                    panic!("{} is no register", signal.name())
                };
                // The index and up to four legs, one leg, or the tables of the indices.
                let most = if matches!(op, Some(Comb::Select(..))) { 1 + GROUP } else { 1 };
                assert!(args.len() <= most, "{}", signal.name());
            }
            // A clock that a product alone does not meet is said to be missed.
            assert_eq!(design.clock().0 < f64::from(frequency), frequency == 200, "{device} at {frequency} MHz");
        }
    }
}

#[test]
fn a_choice_among_values_of_one_stream_is_a_delay_line_where_there_are_such() {
    for (device, lines) in [("xc2v6000-4", true), ("lfe5u-85-6", false)] {
        let design = Design::new(&Params { device: device.to_owned(), ..Params::default() }, Probes::None).unwrap();
        let pipeline = design.top.hierarchy().into_iter().find(|m| m.name == "pair_pipeline").unwrap();
        let has = |name: &str| {
            let line = |i: &&Instance| i.module.name.starts_with("tapped_line") && i.place.base.starts_with(name);
            pipeline.parts().flat_map(|part| &part.instances).filter(line).count()
        };
        // Three components, two bounds; and three sign cases.
        assert_eq!([has("axis_e"), has("axis_f")], if lines { [9, 9] } else { [0, 0] }, "{device}");
        let edges = pipeline.parts().flat_map(|part| &part.signals).filter(|s| s.place.base == "e_a").count();
        assert_eq!(edges == 0, lines, "{device}: registers of edges that lines keep");
    }
}

#[test]
fn long_delays_are_lines_and_short_ones_are_not() {
    let m = Control::new("delays", vec![]);
    let mut chain: Vec<Wire> = vec![m.input("value", Type::signed(5, 0))];
    for i in 1..=8 {
        let next = m.register(format!("value_d{i}").as_str(), Type::signed(5, 0));
        next.loads(chain[i - 1], None, None);
        chain.push(next);
    }
    // Tapped after three and after five clocks: 3 + 2 + 3.
    chain[8].output("late");
    chain[3].apply(Add(None), &[chain[5]]).named("sum").output("sum_out");
    let module = m.finish();
    let names =
        |line: &DelayLine| -> Vec<String> { line.registers.iter().map(|id| module.signal(*id).name()).collect() };
    let lines: Vec<Vec<String>> = module.delay_lines().iter().map(names).collect();
    assert_eq!(lines, [["value_d1", "value_d2", "value_d3"], ["value_d6", "value_d7", "value_d8"]]);
    let text = efsat::vhdl::print(&module, "", "delay_types", &[]).unwrap().remove(1).1;
    for line in [
        "type value_line_t is array (1 to 3) of signed(4 downto 0);",
        "value_line <= signed(value) & value_line(1 to 2);",
        "value_d8_line <= value_d5 & value_d8_line(1 to 2);",
    ] {
        assert!(text.lines().any(|l| l.trim() == line), "{line}\n{text}");
    }
}

/// Numbers that are the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % n) as usize
    }
}

/// A program of five nodes within six clocks.
fn small(random: &mut Random, with_pairs: bool) -> LinearProgram {
    const CLOCKS: i32 = 6;
    let ports = Event { variable: 0, offset: 0 };
    let mut program = LinearProgram {
        variables: (0..6).map(|i| format!("n{i}")).collect(),
        interval: 3,
        constraints: BTreeMap::new(),
        streams: vec![],
        held: vec![],
        fixed: 7,
    };
    for variable in 1..6 {
        let start = Event { variable, offset: 0 };
        program.order(ports, start);
        program.order(start.later(1), ports.later(CLOCKS));
        let after = Event { variable: random.below(variable as u64), offset: random.below(2) as i32 };
        program.order(after, start);
        let mut uses = vec![];
        for _ in 0..1 + random.below(3) {
            let user = variable + 1 + random.below(5);
            let user = if user < 6 { Event { variable: user, offset: 0 } } else { ports.later(CLOCKS) };
            program.order(start, user);
            uses.push(user);
        }
        let bits = 1 + random.below(9) as u32;
        program.streams.push(Stream { name: format!("v{variable}"), bits, from: start, uses: uses.clone() });
        if with_pairs {
            let windows = vec![(after, after.later(3))];
            let reading = Reading { first: start, last: start.later(1), captured: random.below(4) == 0 };
            program.held.push(Held { name: format!("p{variable}"), bits, windows, uses: vec![reading] });
        }
    }
    program
}

/// Every schedule of five nodes within six clocks that keeps to the constraints.
fn all(program: &LinearProgram) -> impl Iterator<Item = Vec<i32>> + '_ {
    let digits = |n: i32| vec![0, n % 6, n / 6 % 6, n / 36 % 6, n / 216 % 6, n / 1296];
    (0..7776).map(digits).filter(|starts| program.holds(starts))
}

#[test]
fn small_programs_are_solved_as_by_trying_everything() {
    let mut random = Random(1);
    let mut moved = 0;
    for i in 0..300 {
        let program = small(&mut random, false);
        let least: Vec<i32> = (0..6).map(|v| all(&program).map(|s| s[v]).min().unwrap()).collect();
        let found = program.optimise(&least);
        let best = all(&program).map(|s| program.cost(&s)).min().unwrap();
        assert!(program.holds(&found));
        assert_eq!(program.cost(&found), best, "{i}: {program:?}");
        moved += usize::from(found != least);
    }
    assert!(moved > 100, "{moved} of 300 differ from the earliest schedule");
}

#[test]
fn captures_are_never_more_than_in_the_earliest_schedule_costs() {
    let mut random = Random(2);
    let mut best = 0;
    for i in 0..300 {
        let program = small(&mut random, true);
        let least: Vec<i32> = (0..6).map(|v| all(&program).map(|s| s[v]).min().unwrap()).collect();
        let found = program.optimise(&least);
        assert!(program.holds(&found) && program.cost(&found) <= program.cost(&least), "{i}: {program:?}");
        best += usize::from(all(&program).all(|s| program.cost(&s) >= program.cost(&found)));
    }
    assert!(best > 150, "{best} of 300 are optimal");
}
