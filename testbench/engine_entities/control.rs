//! Jobs and queries in flight: which are taken, checked, started and reported, in which order, and why they end.

use super::*;
use crate::extent::full;
use efsat::engine::params::ADDRESS_BITS;
use efsat::engine::words::{QueryFlags, Reason};
use std::collections::VecDeque;

/// Addresses in memory.
const LINES: u64 = 1 << ADDRESS_BITS;
/// Clocks in which a report has to come.
const PATIENCE: usize = 2000;
/// Lanes of the engine that is tested.
const LANES: usize = 4;
/// Words of a job: those of a query without its header.
const JOB_WORDS: usize = 22;

/// A job, and what it says of a query.
struct Job {
    /// No other has it.
    id: u32,
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
        let object = if seldom(rng, 5) { rng.random_range(1..3u64) } else { 0 };
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
        words[4] |= u64::from(!seldom(rng, 8)) << QueryFlags::KEEP_CACHES;
        let (number, short, reason) = (
            // So few that some come twice.
            rng.random_range(0..4),
            posed && !query,
            if posed { 0 } else { 6 + rng.random_range(0..3) },
        );
        Self { id: rng.random(), query, posed, short, reason, number, words }
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
}

/// A job that has a lane.
struct Lane {
    job: Job,
    /// Checked, and started if it can be.
    admitted: bool,
    started: bool,
    /// Why it ends, once that is known.
    reason: Option<u64>,
    /// The same, found a clock ago.
    found: Option<u64>,
    stopped: bool,
    /// Nothing is to be done any more.
    idle: bool,
}

struct Control<'a> {
    entity: &'a mut Entity,
    rng: ChaCha8Rng,
    clock: usize,
    /// From the oldest on.
    lanes: VecDeque<Lane>,
    oldest: usize,
    job: Option<Job>,
    /// The job that waits is to be stopped.
    stopped: bool,
    /// Jobs that the stop of the clock before may mean, and those of the stop before that.
    found: [Vec<u32>; 2],
    /// What was told a clock ago: lanes that are idle, whether the oldest query reads, and what memory does wrong.
    idle_before: u64,
    reads_before: bool,
    error_before: Option<Reason>,
    /// Objects that the caches hold.
    known: Option<[u64; 2]>,
    /// Clocks that the caches are still at it, after the pulse.
    flushing: Option<u32>,
    /// What memory does wrong, and whether old bursts are under way.
    error: Option<Reason>,
    draining: bool,
    reporting: bool,
    aborting: bool,
    /// Lanes with a query that had a reason to end a clock ago.
    dropped: u64,
    /// When pairs of packets were last in the unit, and when the last report was.
    unit_busy: usize,
    /// For so many clocks, if they are there now.
    busy_clocks: u32,
    reported: usize,
    reports: u32,
    aborts: u32,
    /// The most queries that were started.
    together: usize,
}

impl Control<'_> {
    fn expect(&self, holds: bool, what: &str) -> Outcome {
        expect(holds, self.clock, what)
    }

    fn number(&self, age: usize) -> usize {
        (self.oldest + age) % LANES
    }

    /// A bit for each lane, and for those without a job.
    fn flags(&self, of: impl Fn(&Lane) -> bool, without: bool) -> u64 {
        let all: u64 = if without { (1 << LANES) - 1 } else { 0 };
        self.lanes.iter().enumerate().fold(all, |flags, (age, lane)| {
            let bit = 1 << self.number(age);
            if of(lane) { flags | bit } else { flags & !bit }
        })
    }

    /// The oldest that is not admitted.
    fn next(&self) -> Option<usize> {
        self.lanes.iter().position(|lane| !lane.admitted)
    }

    /// Events of this clock, each of one lane: what control sees of the queries.
    fn events(&mut self) -> [u64; 3] {
        let mut events = [0; 3];
        for (age, lane) in self.lanes.iter_mut().enumerate() {
            let bit = 1 << ((self.oldest + age) % LANES);
            // A stop, or what memory does wrong, comes as its query is done.
            let stops = self.found.iter().any(|ids| ids.contains(&lane.job.id));
            let fails = age == 0 && self.error.is_some();
            lane.idle |= lane.started && (stops || fails) && seldom(&mut self.rng, 4);
            // Something of others comes with a contact.
            if !lane.started || lane.idle || (events[2] == 0 && !seldom(&mut self.rng, 30)) {
                continue;
            }
            match self.rng.random_range(0..5) {
                0 => events[0] |= bit,
                1 => events[1] |= bit,
                2 | 3 if age == 0 => events[2] = 1,
                _ => lane.idle = true,
            }
        }
        events
    }

    /// What a clock makes of the reasons: they are found in one and taken in the next.
    fn reasons(&mut self, [bad, limit, contact]: [u64; 3]) {
        for (age, lane) in self.lanes.iter_mut().enumerate() {
            let bit = 1 << ((self.oldest + age) % LANES);
            let found = lane.found.take();
            if age == 0 && self.reporting {
                continue;
            }
            if lane.started {
                lane.reason = lane.reason.or(found);
            }
            let due = [
                (bad & bit > 0, Reason::BadTree),
                (contact == 1 && age == 0, Reason::Contact),
                (limit & bit > 0, Reason::Limit),
                (lane.stopped, Reason::Stopped),
            ];
            lane.found = due.into_iter().find(|(found, _)| *found).map(|(_, reason)| reason as u64);
        }
    }

    /// Of those with its number a stop ends the oldest that is not reported, or the job that waits. Numbers are compared in one
    /// clock, queries looked for in the next, and one is stopped in the third.
    fn stop(&mut self, number: Option<u64>) {
        let reporting = self.reporting;
        let [asked, found] = std::mem::take(&mut self.found);
        let first = self.lanes.iter_mut().find(|lane| found.contains(&lane.job.id));
        match first {
            Some(lane) => lane.stopped = true,
            None => self.stopped |= self.job.as_ref().is_some_and(|job| found.contains(&job.id)),
        }
        let reported = self.lanes.front().filter(|_| reporting).map(|lane| lane.job.id);
        let jobs = self.lanes.iter().map(|lane| &lane.job).chain(&self.job);
        let meant = jobs.filter(|job| job.query && Some(job.number) == number).map(|job| job.id);
        self.found = [meant.collect(), asked.into_iter().filter(|&id| Some(id) != reported).collect()];
    }

    fn clock(&mut self) -> Outcome {
        let rng = &mut self.rng;
        // Pairs of packets come to the unit while there is no job, and are still there when one comes behind them.
        let begins = self.job.is_none() && seldom(rng, 6);
        let unit_busy = self.lanes.is_empty() && if self.busy_clocks > 0 { !seldom(rng, 4) } else { begins };
        if unit_busy {
            (self.unit_busy, self.busy_clocks) = (self.clock, self.busy_clocks + 1);
        } else {
            self.busy_clocks = 0;
        }
        // Not before the unit has said so.
        let may_come = self.job.is_none() && (self.busy_clocks == 0 || self.busy_clocks > 2);
        if may_come && seldom(rng, 12) {
            let job = Job::new(rng, JOB_WORDS);
            job.offer(self.entity);
            self.job = Some(job);
        }
        if self.job.is_none() {
            self.entity.set("job_valid", 0);
        }
        let started = self.lanes.front().is_some_and(|lane| lane.started);
        if self.error.is_none() && started && seldom(rng, 150) {
            self.error = Some(if seldom(rng, 2) { Reason::Memory } else { Reason::Silent });
        }
        let silent = self.error == Some(Reason::Silent);
        if self.draining && !silent && seldom(rng, 20) {
            self.draining = false;
        }
        let reads = !seldom(rng, 3);
        let (stops, stop) = (seldom(rng, 25), rng.random_range(0..4));
        for lane in &mut self.lanes {
            // A job that is no query, or a query that is not started, waits for its pose alone.
            lane.idle |= !lane.started && seldom(rng, 4);
        }
        let events = self.events();
        let idle = self.flags(|lane| lane.idle, !unit_busy);
        let idle = std::mem::replace(&mut self.idle_before, idle);
        let report_done = self.reporting && seldom(&mut self.rng, 5);
        for (port, value) in [
            ("idle", idle),
            ("bad_tree", events[0]),
            ("limit_reached", events[1]),
            ("contact", events[2]),
            ("stop", stops.into()),
            ("stop_number", stop),
            ("reads", reads.into()),
            ("memory_error", u64::from(self.error == Some(Reason::Memory))),
            ("memory_silent", silent.into()),
            ("memory_draining", self.draining.into()),
            ("flushing", u64::from(self.flushing.is_some_and(|clocks| clocks > 0))),
            ("report_done", report_done.into()),
        ] {
            self.entity.set(port, value);
        }
        self.entity.settle();
        let checked = (self.entity.get("checked_lane") as usize + LANES - self.oldest) % LANES;
        if let Some(lane) = self.lanes.get(checked) {
            self.entity.set_words("checked", &lane.job.words);
        }
        self.entity.settle();
        if self.entity.is("start") {
            self.starts()?;
            self.idle_before = self.flags(|lane| lane.idle, !unit_busy);
        }
        self.outputs()?;
        if seldom(&mut self.rng, 400) {
            return self.forget();
        }
        self.flow(reads, events)?;
        self.stop(stops.then_some(stop));
        if self.entity.is("job_taken") {
            let job = self.job.take().ok_or(format!("clock {}: a job from nowhere", self.clock))?;
            let lane = self.number(self.lanes.len()) as u64;
            self.expect(self.lanes.len() < LANES && self.entity.get("job_lane") == lane, "job_lane")?;
            let free = !self.lanes.is_empty() || self.clock >= self.unit_busy + 3;
            self.expect(free, "a job while a pair of a packet is in the unit")?;
            let beside = self.lanes.is_empty() || (job.query && self.lanes.iter().all(|lane| lane.job.query));
            self.expect(beside, "another job beside queries")?;
            let (admitted, stopped, reason) = (!job.query, self.stopped, (!job.query).then_some(job.reason));
            self.lanes.push_back(Lane { job, admitted, started: false, reason, found: None, stopped, idle: false });
            self.stopped = false;
        }
        if report_done {
            self.lanes.pop_front();
            self.oldest = (self.oldest + 1) % LANES;
            self.reporting = false;
            self.reports += 1;
            self.reported = self.clock;
        }
        self.edge();
        self.expect(self.clock < self.reported + PATIENCE, "no report any more")
    }

    /// What is set all the time.
    fn outputs(&mut self) -> Outcome {
        if self.entity.is("report_due") && !self.reporting {
            self.report()?;
        }
        let front = |lane: &Lane| self.reporting && std::ptr::eq(lane, &self.lanes[0]);
        for (port, due) in [
            ("started", self.flags(|lane| lane.started, false)),
            ("ending", self.flags(|lane| !lane.started || lane.reason.is_some(), true)),
            ("posed", self.flags(|lane| lane.job.posed, false)),
            ("counting", self.flags(|lane| lane.job.query && !front(lane), false)),
            ("oldest", self.oldest as u64),
            ("oldest_flags", 1 << self.oldest),
            ("job_stored", self.entity.is("job_taken").into()),
            ("job_flags", 1 << self.entity.get("job_lane")),
            ("running", u64::from(!self.lanes.is_empty())),
            ("report_due", self.reporting.into()),
            ("abort", self.aborting.into()),
        ] {
            self.expect(self.entity.get(port) == due, port)?;
        }
        let drops = self.flags(|lane| lane.started && lane.reason.is_some(), false);
        let dropping = std::mem::replace(&mut self.dropped, drops) >> self.oldest & 1 == 1;
        self.expect(self.entity.is("dropping") == dropping, "dropping")?;
        let busy = !self.lanes.is_empty();
        self.expect(self.entity.is("busy") || !busy, "busy")?;
        self.together = self.together.max(self.lanes.iter().filter(|lane| lane.started).count());
        Ok(())
    }

    /// A query starts: the next one, with caches that hold its objects.
    fn starts(&mut self) -> Outcome {
        let age = self.next().ok_or(format!("clock {}: a start of no query", self.clock))?;
        self.expect(self.entity.get("start_lane") == self.number(age) as u64, "start_lane")?;
        let job = &self.lanes[age].job;
        self.expect(job.refused().is_none(), "a start of a query that is refused")?;
        self.expect(self.entity.get("most_expansions") == halves(job.words[4])[0], "most_expansions")?;
        let keeps = self.known == Some(job.bases()) && job.words[4] >> QueryFlags::KEEP_CACHES & 1 == 1;
        self.expect(keeps != self.flushing.is_some(), "caches that are emptied where they have to be")?;
        self.expect(
            self.flushing.is_none_or(|clocks| clocks == 0) && !self.draining,
            "a start before caches are empty",
        )?;
        (self.known, self.flushing) = (Some(job.bases()), None);
        let lane = &mut self.lanes[age];
        (lane.admitted, lane.started, lane.idle) = (true, true, false);
        Ok(())
    }

    /// Why a query that waits for empty caches may be refused: memory owes words and is silent.
    fn silent(&self) -> Option<Reason> {
        let silent = self.draining && self.error == Some(Reason::Silent);
        (self.flushing.is_some() && silent).then_some(Reason::Silent)
    }

    /// The report of the oldest begins.
    fn report(&mut self) -> Outcome {
        self.expect(!self.lanes.is_empty(), "a report of nothing")?;
        if !self.lanes[0].admitted {
            // What is refused does not start.
            let silent = self.silent();
            let lane = &mut self.lanes[0];
            let reason =
                lane.job.refused().or(silent).ok_or(format!("clock {}: a report before its query", self.clock))?;
            (lane.admitted, lane.reason) = (true, Some(reason as u64));
            (self.known, self.flushing) = (None, None);
        }
        let lane = &self.lanes[0];
        self.expect(lane.idle, "a report of a query that works")?;
        for (port, due) in
            [("reason", lane.reason.unwrap_or(0)), ("number", lane.job.number), ("short", lane.job.short.into())]
        {
            self.expect(self.entity.get(port) == due, port)?;
        }
        self.reporting = true;
        Ok(())
    }

    /// Flushes, reasons, and what memory does wrong.
    fn flow(&mut self, reads: bool, events: [u64; 3]) -> Outcome {
        if let Some(clocks) = &mut self.flushing {
            *clocks = clocks.saturating_sub(1);
        }
        if self.entity.is("flush") {
            self.expect(self.next() == Some(0) && self.flushing.is_none(), "a flush while older queries read")?;
            self.flushing = Some(self.rng.random_range(1..6));
        }
        // A query behind others is refused without a word: it is admitted, and the next one is looked at.
        let checked = (self.entity.get("checked_lane") as usize + LANES - self.oldest) % LANES;
        while let Some(age) =
            self.next().filter(|&age| age < checked || (checked == 0 && self.lanes.len() == LANES && age > 0))
        {
            let silent = self.silent();
            self.flushing = None;
            let refused = self.lanes[age].job.refused().or(silent);
            self.expect(refused.is_some(), "a query that is left out")?;
            (self.lanes[age].admitted, self.lanes[age].reason) = (true, refused.map(|reason| reason as u64));
            self.known = None;
        }
        let before = self.lanes.front().and_then(|lane| lane.reason);
        let reads = std::mem::replace(&mut self.reads_before, reads);
        let wrong = std::mem::replace(&mut self.error_before, self.error);
        self.reasons(events);
        let reporting = self.reporting;
        if std::mem::take(&mut self.aborting) {
            let error = self.error;
            self.lanes[0].idle = true;
            // A reason that was found in the clock before comes too late.
            self.lanes[0].reason = before.or(wrong.map(|error| error as u64));
            for lane in self.lanes.iter_mut().skip(1) {
                (lane.admitted, lane.started, lane.reason) = (false, false, None);
            }
            (self.known, self.flushing) = (None, None);
            // Silence may go on.
            self.draining = seldom(&mut self.rng, 2);
            if error == Some(Reason::Memory) || !self.draining || seldom(&mut self.rng, 2) {
                self.error = None;
            }
            self.aborts += 1;
        } else {
            let runs = !reporting && self.lanes.front().is_some_and(|lane| lane.started);
            self.aborting = runs && reads && wrong.is_some();
        }
        Ok(())
    }

    fn edge(&mut self) {
        self.entity.clock();
        self.clock += 1;
    }

    /// A soft reset: all that is left is its report.
    fn forget(&mut self) -> Outcome {
        let number = self.rng.random_range(0..u64::from(QueryFlags::NUMBERS));
        self.entity.set("forget", 1);
        self.entity.set("forget_number", number);
        self.entity.set("report_done", 0);
        self.entity.settle();
        self.edge();
        self.entity.set("forget", 0);
        let (query, posed, short, reason) = (false, false, false, Reason::Reset as u64);
        let job = Job { id: 0, query, posed, short, reason, number, words: vec![0; JOB_WORDS] };
        let (admitted, started, stopped, idle) = (true, false, false, false);
        self.lanes = [Lane { job, admitted, started, reason: Some(reason), found: None, stopped, idle }].into();
        (self.job, self.stopped, self.known, self.flushing, self.error) = (None, false, None, None, None);
        (self.draining, self.reporting, self.aborting, self.dropped) = (false, false, false, 0);
        (self.found, self.reads_before, self.error_before) = Default::default();
        self.idle_before = 0;
        Ok(())
    }
}

fn control(entity: &mut Entity) -> Outcome {
    entity.set("idle", (1 << LANES) - 1);
    entity.reset();
    let mut control = Control {
        entity,
        rng: random(12),
        clock: 3,
        lanes: VecDeque::new(),
        oldest: 0,
        job: None,
        stopped: false,
        found: Default::default(),
        idle_before: (1 << LANES) - 1,
        reads_before: false,
        error_before: None,
        known: None,
        flushing: None,
        error: None,
        draining: false,
        reporting: false,
        aborting: false,
        dropped: 0,
        unit_busy: 0,
        busy_clocks: 0,
        reported: 0,
        reports: 0,
        aborts: 0,
        together: 0,
    };
    // Some mistakes need what happens once in ten thousand clocks.
    let clocks = if full() { 90_000 } else { 30_000 };
    while control.clock < clocks {
        control.clock()?;
    }
    let Control { reports, aborts, together, .. } = control;
    let seen = reports > 300 && aborts > 30 && together > 2;
    expect(seen, clocks, &format!("{reports} reports, {aborts} aborts, {together} queries together"))
}

#[test]
fn jobs_are_checked_and_run_and_reported() {
    let changes = [
        ("job_due <= job_valid and all_idle when", "job_due <= job_valid when"),
        ("when (asked and is_oldest) /= no_lane and (occupied", "when (occupied"),
        ("+ resize(counts(i), 33) > 67108864", "+ resize(counts(i), 33) >= 67108864"),
        ("if counts(0) = 0 or counts(1) = 0 then", "if counts(0) = 0 then"),
        ("if flush_now = '0' and flushing = '0' then", "if flushing = '0' then"),
        ("moved(4) <= not known or not", "moved(4) <= not"),
        // A query starts that is refused; the reason of a memory error is that of all, or a query is done that has failed.
        ("started_pulse <= starts_now;", "started_pulse <= '1';"),
        ("          elsif sound(lane) = '1' then\n", "          else\n"),
        ("elsif done = '1' and fails = '0' then", "elsif done = '1' then"),
        // What has just begun is done.
        ("done <= not (started_pulse or idle_is_old) when", "done <= not idle_is_old when"),
        ("done <= not (started_pulse or idle_is_old) when", "done <= not started_pulse when"),
        // A reason is found too late, or for another query.
        ("(reporting or done) = '0' then", "reporting = '0' then"),
        ("if is_oldest(lane) = '0' or (reporting or done) = '0' then", "if true then"),
        (
            "if (found(lane) and started_now(lane) and sound(lane)) = '1' then",
            "if (found(lane) and sound(lane)) = '1' then",
        ),
        (
            "if (found(lane) and started_now(lane) and sound(lane)) = '1' then",
            "if (found(lane) and started_now(lane)) = '1' then",
        ),
        ("if contact = '1' and is_oldest(lane) = '1' then", "if contact = '1' then"),
        ("if admitted_lane = oldest then", "if admitted_lane = admitted_lane then"),
        // A stop is for whatever runs, for all of a number, or for nobody who waits; a contact for all.
        ("if numbers(lane) = stop_number then", "if true then"),
        ("first(lane) <= found(lane) when earlier = no_lane else '0';", "first(lane) <= found(lane);"),
        ("job_stopped := waiting_stopped or found_job;", "job_stopped := found_job;"),
        ("or (contact and is_oldest(lane)) or", "or contact or"),
        // What memory owes is not waited for, or without end; a query ends that does not read; the others go on.
        ("if memory_draining = '1' then", "if memory_draining = '1' and flushing = '1' then"),
        ("          if memory_silent = '1' then\n", "          if flushing = '1' then\n"),
        ("fails <= reads_before and (error_before", "fails <= (error_before"),
        (
            "            now_started(lane) := '0';\n            now_reasons(lane) := fine;",
            "            now_reasons(lane) := fine;",
        ),
        ("numbers(lane) <= forget_number;", "numbers(lane) <= job_number;"),
        ("stored_now <= now_taken;", "stored_now <= '0';"),
        // Pairs are dropped too long, or of a query that has not begun.
        ("        drops <= no_lane;\n", ""),
        ("drops(lane) <= started_now(lane) and not sound(lane);", "drops(lane) <= not sound(lane);"),
        // A stop for a query that was taken a clock ago is for the one before it in its lane.
        ("if moved(lane) = '1' then", "if false then"),
        // Behind a soft reset, the flag of the next job is another one than its lane.
        ("          is_next <= rotated(is_oldest);\n", ""),
        // The lane that is admitted next is another one than its number says, behind each of what moves it.
        (
            "          is_candidate <= rotated(oldest_flags);\n        end if;\n      end if;\n\n",
            "        end if;\n      end if;\n\n",
        ),
        ("        is_candidate <= rotated(is_candidate);\n", ""),
        ("          is_candidate <= rotated(next_flags);\n", ""),
        ("        is_candidate <= rotated(oldest_flags);\n      end if;\n\n", "      end if;\n\n"),
        ("unadmitted <= occupied and not admitted;", "unadmitted <= occupied;"),
        // A job is taken although the query before it fails, or all is forgotten in that clock.
        (
            "        now_taken := '0';\n        job_found <= '0';\n        started_pulse <= '0';\n        known <= '0';\n        flush",
            "        job_found <= '0';\n        started_pulse <= '0';\n        known <= '0';\n        flush",
        ),
        (
            "        now_taken := '0';\n        job_found <= '0';\n        started_pulse <= '0';\n        known <= '0';\n        admitted",
            "        job_found <= '0';\n        started_pulse <= '0';\n        known <= '0';\n        admitted",
        ),
    ];
    let design =
        EngineDesign::new(&EngineParams { queries: LANES as u32, ..small(Memory::Axi).params }, &Params::default());
    tried_with(
        &design.unwrap(),
        "engine_control",
        &["engine_check", "engine_admission", "engine_stop"],
        &changes,
        control,
    );
}
