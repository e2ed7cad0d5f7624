//! One job after the other: what is done with its pose, what the running query has in its registers, and why it ends.

use super::*;
use efsat::engine::format::EngineFormat;
use efsat::engine::params::ADDRESS_BITS;
use efsat::engine::words::{QueryFlags, Reason};

/// Addresses in memory.
const LINES: u64 = 1 << ADDRESS_BITS;
/// Clocks in which something has to happen.
const PATIENCE: usize = 60;

/// A job, and what it says of a query.
struct Job {
    query: bool,
    posed: bool,
    short: bool,
    reason: u64,
    number: u64,
    words: Vec<u64>,
}

/// Both halves of a word.
fn halves(word: u64) -> [u64; 2] {
    [word & 0xffff_ffff, word >> 32]
}

impl Job {
    fn new(rng: &mut ChaCha8Rng, length: usize) -> Self {
        let mut words: Vec<u64> = (0..length).map(|_| rng.random()).collect();
        let kind = rng.random_range(0..8);
        let (query, posed) = (kind > 1, kind > 0);
        // Objects of which there are few, so that some come again.
        let object = rng.random_range(0..3u64);
        words[0] = (object + 1) << 32 | object;
        words[1] = (LINES - 500) << 32 | 1000;
        words[2] = 20 << 32 | 30;
        words[3] = rng.random_range(0..500) << 32 | 400;
        // A tree without a root; one that ends with the memory, or beyond it.
        match rng.random_range(0..12) {
            0 => words[2] &= !0xffff_ffff,
            1 => words[2] &= 0xffff_ffff,
            2 => words[1] = (LINES - 400) | (7 << 32),
            3 => words[1] = (LINES - 399) | (7 << 32),
            4 => words[0] = (LINES - 20 + u64::from(seldom(rng, 2))) << 32,
            5 => words[0] = 0xffff_ffff,
            _ => {}
        }
        words[4] &= !(1 << QueryFlags::KEEP_CACHES);
        words[4] |= u64::from(!seldom(rng, 6)) << QueryFlags::KEEP_CACHES;
        // Entries of the matrix that fit, and some that do not.
        for word in &mut words[7..13] {
            if seldom(rng, 2) {
                *word = (*word & 0x1fff_ffff_1fff_ffff) ^ if seldom(rng, 2) { 0xf000_0000_f000_0000 } else { 0 };
            }
        }
        // One below the least, with digits that are cut off.
        if seldom(rng, 3) {
            words[8] = 0xf000_0000_f000_07ff;
        }
        let (number, short, reason) = (
            rng.random_range(0..QueryFlags::NUMBERS),
            posed && !query,
            if posed { 0 } else { 6 + rng.random_range(0..3) },
        );
        Self { query, posed, short, reason, number: number.into(), words }
    }

    fn offer(&self, entity: &mut Entity) {
        for (port, value) in [
            ("job_valid", 1),
            ("job_query", self.query.into()),
            ("job_posed", self.posed.into()),
            ("job_short", self.short.into()),
            ("job_reason", self.reason),
            ("job_number", self.number),
        ] {
            entity.set(port, value);
        }
        entity.set_words("job_words", &self.words);
    }

    fn bases(&self) -> [u64; 2] {
        [self.words[0], self.words[1]]
    }

    /// The reason why the query is not run, if there is one.
    fn refused(&self) -> Option<Reason> {
        let ends = |bases: u64, counts: u64| {
            halves(bases).into_iter().zip(halves(counts)).any(|(at, count)| at + count > LINES)
        };
        let outside = ends(self.words[0], self.words[2]) || ends(self.words[1], self.words[3]);
        let empty = halves(self.words[2]).contains(&0);
        if outside { Some(Reason::Memory) } else { empty.then_some(Reason::BadTree) }
    }

    fn number_of_pose(&self, i: usize) -> i64 {
        i64::from(halves(self.words[7 + i / 2])[i % 2] as u32 as i32)
    }

    /// The registers of the running query.
    fn is_held(&self, entity: &Entity, format: &EngineFormat, clock: usize) -> Outcome {
        let expect = |port: &str, value: u64| expect(entity.get(port) == value, clock, port);
        for (i, name) in ["block_base", "triangle_base", "block_count", "triangle_count"].into_iter().enumerate() {
            let [a, b] = halves(self.words[i]);
            expect(&format!("{name}_a"), a)?;
            expect(&format!("{name}_b"), b)?;
        }
        let options = self.words[4];
        expect("most_expansions", halves(options)[0])?;
        for (port, bit) in [
            ("stop_at_contact", QueryFlags::FIRST_CONTACT),
            ("separate_too", QueryFlags::ALL_PAIRS),
            ("leaves_only", QueryFlags::LEAF_PAIRS),
        ] {
            expect(port, options >> bit & 1)?;
        }
        expect("query_errors", self.words[5] & 0xffff_ffff_ffff)?;
        let bits = |words: &[u64], low: usize, count: usize| {
            (0..count).fold(0, |value, i| value | (words[(low + i) / 64] >> ((low + i) % 64) & 1) << i)
        };
        let (pose, shift, rows) = (entity.words("query_pose"), entity.words("query_shift"), entity.words("query_rows"));
        let most = (1 << (format.origin_bits - 1)) - 1;
        for i in 0..9 {
            let entry = (self.number_of_pose(i) >> format.matrix_shift()).clamp(-most, most);
            let width = format.origin_bits as usize;
            super::expect(bits(&pose, width * i, width) == entry as u64 & ((1 << width) - 1), clock, "query_pose")?;
        }
        let width = 32 - format.translation_shift() as usize;
        for i in 0..3 {
            let number = self.number_of_pose(9 + i) >> format.translation_shift();
            super::expect(bits(&shift, width * i, width) == number as u64 & ((1 << width) - 1), clock, "query_shift")?;
        }
        let width = (format.rest_at() + format.rest_bits()) as usize;
        for direction in 0..format.k() as usize {
            let row = self.words[13 + direction] & ((1 << width) - 1);
            super::expect(bits(&rows, width * direction, width) == row, clock, "query_rows")?;
        }
        Ok(())
    }
}

struct Control<'a> {
    entity: &'a mut Entity,
    rng: ChaCha8Rng,
    format: EngineFormat,
    clock: usize,
    /// Objects that the caches hold.
    known: Option<[u64; 2]>,
}

impl Control<'_> {
    fn edge(&mut self) {
        self.entity.clock();
        self.clock += 1;
    }

    fn expect(&self, holds: bool, what: &str) -> Outcome {
        expect(holds, self.clock, what)
    }

    /// Clocks until an output is set, with a look at each before.
    fn until(&mut self, port: &str, each: impl Fn(&mut Self) -> Outcome) -> Outcome {
        for _ in 0..PATIENCE {
            self.entity.settle();
            if self.entity.is(port) {
                return Ok(());
            }
            each(self)?;
            self.edge();
        }
        Err(format!("clock {}: never {port}", self.clock))
    }

    /// Some clocks, with a look at each.
    fn during(&mut self, clocks: usize, each: impl Fn(&mut Self) -> Outcome) -> Outcome {
        for _ in 0..clocks {
            self.entity.settle();
            each(self)?;
            self.edge();
        }
        Ok(())
    }

    fn none_of(&self, ports: &[&str]) -> Outcome {
        ports.iter().try_for_each(|port| self.expect(!self.entity.is(port), port))
    }

    /// A job is taken when nothing is under way, and its pose is given away once, before.
    /// Whether it is to be stopped.
    fn take(&mut self, job: &Job) -> Result<bool, String> {
        for _ in 0..self.rng.random_range(0..6) {
            // A stop has nothing to end, whatever its number.
            let stop = u64::from(seldom(&mut self.rng, 3));
            self.entity.set("stop", stop);
            self.entity.set("stop_number", job.number);
            self.entity.settle();
            self.none_of(&["busy", "running", "start", "report_due", "pose_valid", "job_taken", "dropping"])?;
            self.expect(self.entity.is("ending") && self.entity.is("separate_too"), "while no query runs")?;
            self.edge();
        }
        self.entity.set("stop", 0);
        self.entity.set("idle", 0);
        // Pairs of packets are in the unit for two clocks before the job comes.
        self.during(2, |_| Ok(()))?;
        job.offer(self.entity);
        let clocks = self.rng.random_range(0..4);
        self.during(clocks, |control| {
            control.none_of(&["pose_valid", "job_taken", "start", "report_due"])?;
            control.expect(control.entity.is("busy"), "busy")
        })?;
        self.entity.set("idle", 1);
        let (mut given, mut stopped) = (0, false);
        for _ in 0..PATIENCE {
            let ready = u64::from(seldom(&mut self.rng, 3));
            self.entity.set("pose_ready", ready);
            // For the job that waits, or for another one.
            let own = job.query && seldom(&mut self.rng, 30);
            let other = job.number ^ 1 << self.rng.random_range(0..QueryFlags::NUMBER_BITS);
            self.entity.set("stop", u64::from(own || seldom(&mut self.rng, 4)));
            self.entity.set("stop_number", if own { job.number } else { other });
            stopped |= own;
            self.entity.settle();
            self.expect(self.entity.is("busy"), "busy")?;
            self.none_of(&["start", "report_due", "running"])?;
            if self.entity.is("job_taken") {
                self.expect(given == u32::from(job.posed), "the pose is given once")?;
                self.edge();
                self.entity.set("pose_ready", 0);
                self.entity.set("stop", 0);
                // The next job is shifted into the same register.
                self.entity.set("job_valid", 0);
                self.entity.set_words("job_words", &vec![0x5555_5555_5555_5555; job.words.len()]);
                return Ok(stopped);
            }
            given += u32::from(self.entity.is("pose_valid") && ready == 1);
            self.edge();
        }
        Err(format!("clock {}: the job is never taken", self.clock))
    }

    /// A query from its check to its end; the reason.
    fn query(&mut self, job: &Job, stopped: bool) -> Result<u64, String> {
        self.entity.set("idle", 1);
        if let Some(reason) = job.refused() {
            self.until("report_due", |control| control.none_of(&["start", "flush", "abort"]))?;
            // The registers now have the bases of this query, whose objects were never in the caches.
            self.known = None;
            return Ok(reason as u64);
        }
        let flushes = self.known != Some(job.bases()) || job.words[4] >> QueryFlags::KEEP_CACHES & 1 == 0;
        if flushes {
            self.until("flush", |control| control.none_of(&["start", "report_due"]))?;
            self.edge();
            self.entity.set("flushing", 1);
            let clocks = self.rng.random_range(1..5);
            self.during(clocks, |control| control.none_of(&["start", "report_due", "flush"]))?;
            // Old bursts may be under way for longer than the caches take, and for ever.
            if self.known.is_none() && seldom(&mut self.rng, 2) {
                self.entity.set("memory_draining", 1);
                self.entity.set("flushing", 0);
                self.during(5, |control| control.none_of(&["start", "report_due", "flush"]))?;
                if seldom(&mut self.rng, 2) {
                    self.entity.set("memory_silent", 1);
                    self.until("report_due", |control| control.none_of(&["start", "flush", "abort"]))?;
                    self.entity.set("memory_silent", 0);
                    self.entity.set("memory_draining", 0);
                    return Ok(Reason::Silent as u64);
                }
                self.entity.set("memory_draining", 0);
            }
            self.entity.set("flushing", 0);
        }
        self.until("start", |control| control.none_of(&["report_due", "flush"]))?;
        self.known = Some(job.bases());
        self.expect(self.entity.is("running") && !self.entity.is("ending"), "a query that runs")?;
        job.is_held(self.entity, &self.format, self.clock)?;
        self.entity.set("idle", 0);
        self.during(1, |_| Ok(()))?;
        if stopped {
            self.until("ending", |control| control.none_of(&["report_due"]))?;
            self.entity.set("idle", 1);
            self.until("report_due", |control| control.none_of(&["abort"]))?;
            return Ok(Reason::Stopped as u64);
        }
        // A stop for another query, which may be that which waits behind this one.
        self.entity.set("stop_number", job.number ^ 1 << self.rng.random_range(0..QueryFlags::NUMBER_BITS));
        self.entity.set("stop", 1);
        self.during(1, |_| Ok(()))?;
        self.entity.set("stop", 0);
        let clocks = self.rng.random_range(1..8);
        self.during(clocks, |control| control.none_of(&["start", "report_due", "ending", "dropping", "abort"]))?;
        self.entity.set("stop_number", job.number);
        self.end()
    }

    /// Ends the query that runs.
    fn end(&mut self) -> Result<u64, String> {
        let events = [
            ("contact", 1),
            ("limit_reached", 2),
            ("bad_tree", 3),
            ("stop", 5),
            ("memory_error", 4),
            ("memory_silent", 9),
        ];
        let event = self.rng.random_range(0..=events.len());
        let Some(&(port, reason)) = events.get(event) else {
            self.entity.set("idle", 1);
            self.until("report_due", |control| control.none_of(&["dropping", "abort"]))?;
            return Ok(0);
        };
        self.entity.set(port, 1);
        if port.starts_with("memory") {
            // What is idle then does not count, and what memory still owes is not waited for.
            self.entity.set("idle", u64::from(seldom(&mut self.rng, 2)));
            self.until("abort", |control| control.none_of(&["report_due"]))?;
            self.edge();
            self.entity.set(port, 0);
            self.entity.settle();
            self.none_of(&["abort"])?;
            self.known = None;
            self.until("report_due", |control| control.none_of(&["abort"]))?;
            return Ok(reason);
        }
        self.during(1, |_| Ok(()))?;
        self.entity.set(port, 0);
        // A stop is known a clock later than what the query itself says.
        let clocks = self.rng.random_range(2..8);
        self.during(clocks, |control| control.none_of(&["start", "report_due", "abort"]))?;
        self.entity.settle();
        self.expect(self.entity.is("ending") && self.entity.is("dropping"), "a query that ends")?;
        // Another event does not change the reason.
        let other = ["contact", "bad_tree"][usize::from(port == "contact")];
        self.entity.set(other, 1);
        self.during(1, |_| Ok(()))?;
        self.entity.set(other, 0);
        self.entity.set("idle", 1);
        self.until("report_due", |control| control.none_of(&["abort"]))?;
        Ok(reason)
    }

    /// A soft reset, in whatever phase: then its report.
    fn forget(&mut self) -> Outcome {
        let number = self.rng.random_range(0..u64::from(QueryFlags::NUMBERS));
        self.entity.set("forget", 1);
        self.entity.set("forget_number", number);
        self.during(1, |_| Ok(()))?;
        for port in ["forget", "forget_number", "flushing", "stop", "pose_ready", "job_valid"] {
            self.entity.set(port, 0);
        }
        self.known = None;
        self.entity.set("idle", 1);
        self.until("report_due", |_| Err("something else than a report".to_owned()))?;
        let (query, posed, short) = (false, false, false);
        let report = Job { query, posed, short, reason: 0, number, words: vec![] };
        self.report(&report, Reason::Reset as u64)
    }

    /// The report of a job, until it is done.
    fn report(&mut self, job: &Job, reason: u64) -> Outcome {
        for left in (0..self.rng.random_range(1..6)).rev() {
            self.entity.set("report_done", u64::from(left == 0));
            self.entity.settle();
            self.expect(self.entity.is("report_due") && self.entity.is("busy"), "report_due")?;
            self.none_of(&["running", "start", "dropping", "job_taken"])?;
            for (port, value) in [("reason", reason), ("number", job.number), ("short", job.short.into())] {
                self.expect(self.entity.get(port) == value, port)?;
            }
            self.edge();
        }
        self.entity.set("report_done", 0);
        Ok(())
    }
}

fn control(entity: &mut Entity) -> Outcome {
    let format = small(Memory::Axi).format;
    entity.set("idle", 1);
    entity.reset();
    let length = (format.query_words() - 1) as usize;
    let mut control = Control { entity, rng: random(12), format, clock: 0, known: None };
    for _ in 0..150 {
        let job = Job::new(&mut control.rng, length);
        if seldom(&mut control.rng, 4) {
            // At some clock of the job.
            job.offer(control.entity);
            control.entity.set("pose_ready", 1);
            control.entity.set("flushing", u64::from(seldom(&mut control.rng, 2)));
            control.entity.set("stop_number", job.number);
            control.entity.set("stop", u64::from(seldom(&mut control.rng, 2)));
            let clocks = control.rng.random_range(0..14);
            control.during(clocks, |_| Ok(()))?;
            control.forget()?;
            continue;
        }
        let stopped = control.take(&job)?;
        let reason = if job.query { control.query(&job, stopped)? } else { job.reason };
        control.until("report_due", |_| Ok(()))?;
        control.report(&job, reason)?;
    }
    Ok(())
}

#[test]
fn a_job_is_checked_and_run_and_reported() {
    let changes = [
        ("job_due <= job_valid and idle_before when", "job_due <= job_valid when"),
        ("pose_ready = '1' or job_posed = '0'", "pose_ready = '1' or pose_ready = '0'"),
        ("+ resize(counts(i), 33) > 67108864", "+ resize(counts(i), 33) >= 67108864"),
        ("if counts(0) = 0 or counts(1) = 0 then", "if counts(0) = 0 then"),
        ("if flush_now = '0' and flushing = '0' then", "if flushing = '0' then"),
        ("        if known = '0' or bases(0) /=", "        if bases(0) /="),
        // A stop is for whatever runs, or waits; it is forgotten, or outlives its query.
        ("stop and running_now when number_now = stop_number else '0'", "stop and running_now"),
        ("not stops_running when job_number = stop_number else '0'", "not stops_running"),
        ("stopped <= stopped_waiting or stops_waiting;", "stopped <= stops_waiting;"),
        ("          stopped_waiting <= '0';\n        end if;", "        end if;"),
        // What memory owes is not waited for, or without end; a soft reset keeps the caches.
        ("if memory_draining = '1' then", "if memory_draining = '1' and flushing = '1' then"),
        ("            if memory_silent = '1' then\n", "            if flushing = '1' then\n"),
        ("if (memory_error or memory_silent) = '1' then", "if memory_error = '1' then"),
        ("next_reason := reason_reset;\n        known <= '0';", "next_reason := reason_reset;"),
        ("number_now <= forget_number;", "number_now <= job_number;"),
        ("above /= \"1111\" or cut = \"100000000000000000\"", "above /= \"1111\""),
        ("if ending_now = '0' then", "if running_now = '1' then"),
    ];
    tried(&small(Memory::Axi), "engine_control", &changes, control);
}
