//! Packets in: what becomes of each, good or bad, and what waits for what.

use super::*;
use efsat::engine::format::EngineFormat;
use efsat::engine::words::{Command, QueryFlags, Reason};
use efsat::words::{PacketKind, StreamReport};
use std::collections::VecDeque;

/// What comes of a packet.
enum Work {
    Job {
        query: bool,
        posed: bool,
        short: bool,
        reason: u64,
        number: u64,
        /// Words of the job from a place on.
        words: (usize, Vec<u64>),
        /// Stops that come before it is taken: those right behind its packet do not wait for it.
        stops: usize,
    },
    Pair {
        words: Vec<u64>,
        last: bool,
    },
    Write {
        triangles: bool,
        line: u64,
        place: u64,
        word: u64,
    },
    /// A soft reset by the stream, with its number.
    Reset(u64),
}

/// A word of the stream: data, whether all its bytes are there, whether it is the last.
type Word = (u64, bool, bool);

struct Packets {
    rng: ChaCha8Rng,
    format: EngineFormat,
    /// Lines of each memory.
    lines: u64,
    words: VecDeque<Word>,
    /// Each with the number of its packet.
    due: VecDeque<(usize, Work)>,
    /// Numbers of queries in stops, each with the number of its packet.
    stopped: VecDeque<(usize, u64)>,
    stops: usize,
    packets: usize,
}

/// The report of one word that a packet of pairs or a pose has.
fn short(reason: Reason) -> u64 {
    match reason {
        Reason::UnknownHeader => StreamReport::UnknownHeader as u64,
        Reason::TooShort => StreamReport::TooShort as u64,
        _ => StreamReport::TooLong as u64,
    }
}

impl Packets {
    fn random(&mut self, count: u32) -> Vec<u64> {
        (0..count).map(|_| self.rng.random()).collect()
    }

    /// Sends a packet; the word at one place may lack bytes.
    fn send(&mut self, words: &[u64], holed: Option<usize>) {
        let end = words.len() - 1;
        self.packets += 1;
        self.words.extend(words.iter().enumerate().map(|(i, &word)| (word, holed != Some(i), i == end)));
    }

    fn due(&mut self, work: Work) {
        self.due.push_back((self.packets, work));
    }

    /// The report of a packet, of one word or of eight.
    fn report(&mut self, reason: u64, short: bool) {
        let words = (0, vec![]);
        self.due(Work::Job { query: false, posed: false, short, reason, number: 0, words, stops: 0 });
    }

    fn refused(&mut self, reason: Reason) {
        self.report(reason as u64, false);
    }

    /// The words of a good query.
    fn query_words(&mut self) -> Vec<u64> {
        let format = self.format;
        let mut words = self.random(format.query_words());
        words[0] = format.header(Command::Query);
        words[5] &= !(0xf << 36);
        words[EngineFormat::POSE_AT as usize] &= !(1 << 31);
        let choice = (1u64 << format.choice_bits()) - 1;
        for row in &mut words[format.row_at(0) as usize..] {
            *row &= (1 << (format.rest_at() + format.rest_bits())) - 1;
            for (slot, directions) in (0..).zip(format.directions.slots()) {
                let at = format.choice_at(slot);
                let chosen = self.rng.random_range(0..directions.len()) as u64;
                *row = *row & !(choice << at) | chosen << at;
            }
        }
        words
    }

    /// Headers with nothing behind them, with a byte that is missing, and with bits that mean nothing.
    fn headers(&mut self) {
        let query = self.query_words();
        self.send(&query, Some(0));
        self.refused(Reason::UnknownHeader);
        self.send(&[self.format.header(Command::Load), 0, 0], Some(0));
        self.refused(Reason::UnknownHeader);
        for kind in [PacketKind::Pairs, PacketKind::Pose] {
            self.send(&[self.format.stream.header(kind).into(), 0], Some(0));
            self.report(short(Reason::UnknownHeader), true);
        }
        for order in [Command::Stop, Command::Reset].map(|command| self.format.order(command, 5)) {
            for words in [&[order | 1 << 32][..], &[order | 1 << 39, 0]] {
                self.send(words, None);
                self.refused(Reason::UnknownHeader);
            }
            self.send(&[order], Some(0));
            self.refused(Reason::UnknownHeader);
            self.send(&[order, 0], Some(0));
            self.refused(Reason::UnknownHeader);
            self.send(&[order, 0], None);
            self.refused(Reason::TooLong);
        }
        for command in [Command::Query, Command::Load] {
            self.send(&[self.format.header(command)], None);
            self.refused(Reason::TooShort);
        }
        for kind in [PacketKind::Pairs, PacketKind::Pose] {
            self.send(&[self.format.stream.header(kind).into()], None);
            self.report(short(Reason::TooShort), true);
        }
    }

    fn query(&mut self) {
        let format = self.format;
        let mut words = self.query_words();
        let last = words.len() - 1;
        let row = self.rng.random_range(format.row_at(0) as usize..=last);
        let (mut reason, mut holed) = (Reason::Complete, None);
        match self.rng.random_range(0..12) {
            0 => {
                // The header alone, too, while another job waits.
                words.truncate(if seldom(&mut self.rng, 2) { 1 } else { self.rng.random_range(1..=last) });
                reason = Reason::TooShort;
            }
            1 => {
                words.extend([0; 2]);
                reason = Reason::TooLong;
            }
            2 => {
                words[0] ^= 1 << self.rng.random_range(32..64);
                reason = Reason::UnknownHeader;
            }
            3 => {
                words[5] |= 1 << self.rng.random_range(36..40);
                reason = Reason::UnknownHeader;
            }
            4 => {
                words[EngineFormat::POSE_AT as usize] |= 1 << 31;
                reason = Reason::UnknownHeader;
            }
            5 => {
                // A choice that there is not.
                words[row] |= 7 << format.choice_at(self.rng.random_range(0..3));
                reason = Reason::UnknownHeader;
            }
            6 => {
                words[row] |= 1 << self.rng.random_range(format.rest_at() + format.rest_bits()..64);
                reason = Reason::UnknownHeader;
            }
            7 => {
                let at = if self.rng.random() { 0 } else { self.rng.random_range(1..=last) };
                holed = Some(at);
                reason = if at == 0 { Reason::UnknownHeader } else { Reason::TooShort };
            }
            _ => {}
        }
        self.send(&words, holed);
        if reason != Reason::Complete {
            return self.refused(reason);
        }
        let (number, words) = (words[5] >> QueryFlags::NUMBER_AT, (0, words[1..].to_vec()));
        self.due(Work::Job { query: true, posed: true, short: false, reason: 0, number, words, stops: 0 });
    }

    fn pose(&mut self) {
        let header = u64::from(self.format.stream.header(PacketKind::Pose));
        let record = self.random(self.format.pose_words);
        let mut words = [vec![header], record.clone()].concat();
        let last = words.len() - 1;
        let (mut reason, mut holed) = (Reason::Complete, None);
        match self.rng.random_range(0..9) {
            0 => {
                // The header alone, too.
                words.truncate(if seldom(&mut self.rng, 2) { 1 } else { self.rng.random_range(1..=last) });
                reason = Reason::TooShort;
            }
            1 => {
                words.extend([0; 3]);
                reason = Reason::TooLong;
            }
            2 => {
                words[0] ^= 1 << self.rng.random_range(8..32);
                reason = Reason::UnknownHeader;
            }
            3 => {
                holed = Some(self.rng.random_range(1..=last));
                reason = Reason::TooShort;
            }
            4 => {
                holed = Some(0);
                reason = Reason::UnknownHeader;
            }
            _ => {}
        }
        self.send(&words, holed);
        if reason != Reason::Complete {
            return self.report(short(reason), true);
        }
        let words = (EngineFormat::POSE_AT as usize - 1, record);
        self.due(Work::Job { query: false, posed: true, short: true, reason: 0, number: 0, words, stops: 0 });
    }

    fn pairs(&mut self) {
        let length = self.format.stream.record_words(PacketKind::Pairs) as usize;
        let count = self.rng.random_range(1..4);
        let records = self.random((count * length) as u32);
        let mut words = [vec![u64::from(self.format.stream.header(PacketKind::Pairs))], records.clone()].concat();
        let (mut whole, mut holed, mut reason) = (count, None, Reason::TooShort);
        match self.rng.random_range(0..6) {
            0 => {
                // Anywhere but behind a pair, which would be the last one.
                whole = self.rng.random_range(0..count);
                words.truncate(1 + whole * length + self.rng.random_range(usize::from(whole > 0)..length));
            }
            1 => {
                whole = self.rng.random_range(0..count);
                holed = Some(1 + whole * length + self.rng.random_range(0..length));
            }
            2 => (whole, holed, reason) = (0, Some(0), Reason::UnknownHeader),
            _ => {}
        }
        self.send(&words, holed);
        for (i, pair) in records.chunks(length).enumerate().take(whole) {
            self.due(Work::Pair { words: pair.to_vec(), last: i + 1 == count });
        }
        if whole < count {
            self.report(short(reason), true);
        }
    }

    fn load(&mut self) {
        let triangles: bool = self.rng.random();
        let line = self.rng.random_range(0..self.lines);
        let mut address = line << 6 | u64::from(triangles) << 31;
        let count = 8 * self.rng.random_range(1..4u32);
        let mut data = self.random(count);
        let (mut reason, mut holed, mut written) = (Reason::Complete, None, data.len());
        let room = 8 * (self.lines - line) as usize;
        match self.rng.random_range(0..10) {
            0 => {
                address ^= 1 << [0, 3, 5, 32, 63][self.rng.random_range(0..5)];
                (reason, written) = (Reason::UnknownHeader, 0);
            }
            1 => {
                // The first line behind the memory, and any other that an address can name.
                address |= self.lines << 6 << self.rng.random_range(0..20);
                (reason, written) = (Reason::TooLong, 0);
            }
            2 => {
                // Within a line, or in front of all.
                let lines = self.rng.random_range(0..data.len() / 8);
                data.truncate(8 * lines + self.rng.random_range(usize::from(lines > 0)..8));
                (reason, written) = (Reason::TooShort, data.len());
            }
            3 => {
                written = self.rng.random_range(0..data.len());
                (reason, holed) = (Reason::TooShort, Some(2 + written));
            }
            4 => (reason, holed, written) = (Reason::UnknownHeader, Some(0), 0),
            _ => {}
        }
        if written > room {
            (reason, written) = (Reason::TooLong, room);
        }
        self.send(&[vec![self.format.header(Command::Load), address], data.clone()].concat(), holed);
        for (i, &word) in (0..).zip(&data[..written]) {
            self.due(Work::Write { triangles, line: line + i / 8, place: i % 8, word });
        }
        self.refused(reason);
    }

    fn stop(&mut self) {
        let number = self.rng.random_range(0..QueryFlags::NUMBERS);
        let header = self.format.order(Command::Stop, number);
        if seldom(&mut self.rng, 4) {
            return self.long_order(header);
        }
        if seldom(&mut self.rng, 8) {
            self.send(&[header], Some(0));
            return self.refused(Reason::UnknownHeader);
        }
        self.send(&[header], None);
        self.stops += 1;
        self.stopped.push_back((self.packets, header >> QueryFlags::NUMBER_AT));
        if let Some((_, Work::Job { stops, .. })) = self.due.back_mut() {
            *stops = self.stops;
        }
    }

    /// The header of a stop or a soft reset with a word behind it.
    fn long_order(&mut self, header: u64) {
        let hole = seldom(&mut self.rng, 2);
        self.send(&[header, 0], hole.then_some(0));
        self.refused(if hole { Reason::UnknownHeader } else { Reason::TooLong });
    }

    /// Headers of stops and soft resets that are none are of no kind.
    fn reset(&mut self) {
        let number = self.rng.random_range(0..QueryFlags::NUMBERS);
        let header = self.format.order(Command::Reset, number);
        match self.rng.random_range(0..6) {
            0 => self.long_order(header),
            1 => {
                let command = [Command::Stop, Command::Reset][self.rng.random_range(0..2)];
                let spare = self.rng.random_range(32..QueryFlags::NUMBER_AT);
                let words = [self.format.order(command, number) | 1 << spare, 0];
                let count = self.rng.random_range(1..=2);
                self.send(&words[..count], None);
                self.refused(Reason::UnknownHeader);
            }
            2 => {
                self.send(&[header], Some(0));
                self.refused(Reason::UnknownHeader);
            }
            _ => {
                self.send(&[header], None);
                self.due(Work::Reset(number.into()));
            }
        }
    }

    /// Everything of packets up to a number is forgotten; how many stops that are.
    fn forget(&mut self, packet: usize) -> usize {
        self.due.retain(|(of, _)| *of > packet);
        let before = self.stopped.len();
        self.stopped.retain(|(of, _)| *of > packet);
        before - self.stopped.len()
    }

    fn next(&mut self) {
        match self.rng.random_range(0..14) {
            0..4 => self.query(),
            4 | 5 => self.pose(),
            6 | 7 => self.pairs(),
            8 | 9 => self.load(),
            10 | 11 => self.stop(),
            12 => self.reset(),
            _ => {
                let words = self.random(3);
                // Of no kind that there is.
                self.send(&[vec![words[0] | 0x40], words].concat(), None);
                self.refused(Reason::UnknownHeader);
            }
        }
    }

    /// What the entity gives in this clock is what is due.
    fn given(&mut self, entity: &Entity, clock: usize, takes: [bool; 2]) -> Outcome {
        let [takes_job, takes_pair] = takes;
        let writes = [entity.is("block_write"), entity.is("triangle_write")];
        let job_words = || entity.words("job_words");
        if writes != [false; 2] {
            let Some((_, Work::Write { triangles, line, place, word })) = self.due.pop_front() else {
                return Err(format!("clock {clock}: a word is written from nowhere"));
            };
            expect(writes == [!triangles, triangles], clock, "which memory")?;
            let found = ["write_line", "write_place", "write_data"].map(|port| entity.get(port));
            expect(found == [line, place, word], clock, "what is written")?;
        }
        if takes_pair {
            let Some((_, Work::Pair { words, last })) = self.due.pop_front() else {
                return Err(format!("clock {clock}: a pair from nowhere"));
            };
            expect(job_words().ends_with(&words), clock, "words of a pair")?;
            expect(entity.is("pair_last") == last, clock, "pair_last")?;
        }
        if takes_job {
            let Some((_, Work::Job { query, posed, short, reason, number, words: (at, words), .. })) =
                self.due.pop_front()
            else {
                return Err(format!("clock {clock}: a job from nowhere"));
            };
            let found = ["job_query", "job_posed", "job_short"].map(|port| entity.is(port));
            expect(found == [query, posed, short], clock, "kind of the job")?;
            expect(query || entity.get("job_reason") == reason, clock, "job_reason")?;
            expect(entity.get("job_number") == number, clock, "job_number")?;
            expect(job_words()[at..].starts_with(&words), clock, "job_words")?;
        }
        Ok(())
    }
}

fn command(entity: &mut Entity) -> Outcome {
    let design = small(Memory::BlockRam);
    let lines = design.params.block_lines.into();
    let mut packets = Packets {
        rng: random(13),
        format: design.format,
        lines,
        words: VecDeque::new(),
        due: VecDeque::new(),
        stopped: VecDeque::new(),
        stops: 0,
        packets: 0,
    };
    entity.reset();
    packets.headers();
    (0..500).for_each(|_| packets.next());
    let (mut working, mut stops, mut quiet) = (0, 0, 0);
    // Packets of which a word was taken, and whether the next word is the first of one.
    let (mut begun, mut first, mut resets) = (0, true, 0);
    // Clocks in which nothing is taken, so that a soft reset is seen to overtake what waits, and how often it does.
    let (mut hold, mut seen, mut waited, mut overtakes) = (0u32, false, false, 0);
    // A clock before, a soft reset by the stream is announced.
    let mut announced = false;
    let (mut had_job, mut took_job, mut words_before) = (false, false, vec![]);
    // A word that was offered stays until it is taken.
    let mut offered = false;
    for clock in 0.. {
        offered |= !packets.words.is_empty() && !seldom(&mut packets.rng, 4);
        let word = packets.words.front().filter(|_| offered).copied();
        let (data, whole, last) = word.unwrap_or((u64::MAX, true, true));
        entity.set("s_axis_tvalid", word.is_some().into());
        entity.set("s_axis_tdata", data);
        entity.set("s_axis_tkeep", if whole { 0xff } else { 0x7f });
        entity.set("s_axis_tlast", last.into());
        entity.settle();
        // Something runs from the job on; what is below depends on it.
        let (job, pair) = (entity.is("job_valid"), entity.is("pair_valid"));
        let held = matches!(packets.due.front(), Some((_, Work::Job { stops: first, .. })) if stops < *first);
        let soft = seldom(
            &mut packets.rng,
            match hold {
                26.. => 6,
                // Seldom at first, for the packets that are there once.
                _ if clock % 2000 < 1000 => 1000,
                _ => 100,
            },
        );
        let is_reset = word
            .is_some_and(|(word, whole, last)| first && whole && last && packets.format.is_order(Command::Reset, word));
        // One that waits behind words of a query waits for the job before them.
        hold = if is_reset && !seen { 30 } else { hold.saturating_sub(1) };
        seen = is_reset;
        // Also in the clock in which such a word is taken.
        let soft = soft && (hold == 0 || hold > 25);
        let takes_job = job && working == 0 && !held && !soft && hold == 0 && seldom(&mut packets.rng, 3);
        let takes_pair = pair && !soft && hold == 0 && seldom(&mut packets.rng, 3);
        // A job that waits holds up others by itself.
        for (port, value) in
            [("soft_reset", soft), ("job_taken", takes_job), ("pair_taken", takes_pair), ("busy", working > 0)]
        {
            entity.set(port, value.into());
        }
        entity.settle();
        expect(working == 0 || !(pair || entity.is("block_write") || entity.is("triangle_write")), clock, "busy")?;
        if entity.is("stop") {
            stops += 1;
            let due = packets.stopped.pop_front().map(|(_, number)| number);
            expect(due == Some(entity.get("stop_number")), clock, "stop_number")?;
        }
        let mut forgets = soft;
        let reset_word = announced;
        announced = entity.is("forgets") && !soft;
        expect(reset_word || entity.get("forget_number") == 0, clock, "a number of a soft reset by the port")?;
        if reset_word {
            // What comes before it is forgotten.
            let at = packets.due.iter().position(|(_, work)| matches!(work, Work::Reset(_)));
            let Some((_, Work::Reset(number))) = at.and_then(|at| packets.due.drain(..=at).next_back()) else {
                return Err(format!("clock {clock}: a soft reset from nowhere"));
            };
            expect(entity.get("forget_number") == number, clock, "number of a soft reset")?;
            expect(!entity.is("pair_valid"), clock, "a pair from before a soft reset")?;
            forgets = true;
            resets += 1;
            overtakes += usize::from(waited && hold > 0);
        }
        // A job is taken a clock after it is there at the earliest; it is read a clock before it is taken and a clock after, too.
        let words = entity.words("job_words");
        expect(!(took_job || takes_job && had_job) || words == words_before, clock, "words of a job that change")?;
        (had_job, took_job, words_before) = (job, takes_job, words);
        waited = job || pair;
        packets.given(entity, clock, [takes_job, takes_pair])?;
        working = if takes_job { packets.rng.random_range(0..120) } else { u32::saturating_sub(working, 1) };
        let arrives = word.is_some() && entity.is("s_axis_tready");
        if arrives {
            packets.words.pop_front();
            offered = false;
            begun += usize::from(first);
            first = last;
        }
        if soft {
            // The rest of a packet too, which is not answered.
            stops += packets.forget(begun);
        }
        working = if forgets { 0 } else { working };
        quiet = if arrives || takes_job || takes_pair || working > 0 { 0 } else { quiet + 1 };
        entity.clock();
        if quiet > 100 {
            let done = packets.words.is_empty() && packets.due.is_empty() && stops == packets.stops;
            return expect(done && resets > 5 && overtakes > 2, clock, "a packet without its answer");
        }
    }
    Ok(())
}

#[test]
fn every_packet_becomes_what_it_is() {
    let changes = [
        ("busy and (header.load or header.pairs)", "busy and header.load"),
        ("busy and (header.load or header.pairs)", "busy and header.pairs"),
        ("(header.stop or not waits)", "not waits"),
        ("head_valid and not goes", "head_valid"),
        ("at_header <= head_last;", "at_header <= '0';"),
        ("at_header <= not (soft_reset and stays_within) or reset;", "at_header <= '0';"),
        ("((pending or closing) and", "(pending and"),
        // The header of a query is taken early: one that ends its packet, words behind it, and what the job before is.
        ("(head_last or not header.query)", "not header.query"),
        // A header is not told from one that differs in a part of it.
        ("head_kind(is_query) and head_kind(is_formatted);", "head_kind(is_query);"),
        ("header.query <= head_whole and ", "header.query <= "),
        ("header.pairs <= head_whole and ", "header.pairs <= "),
        ("header.pose <= head_whole and ", "header.pose <= "),
        ("header.load <= head_whole and ", "header.load <= "),
        ("header.stop <= head_whole and head_last and ", "header.stop <= head_last and "),
        ("header.soft_reset <= head_whole and head_last and ", "header.soft_reset <= head_last and "),
        ("header.soft_reset <= head_whole and head_last and ", "header.soft_reset <= head_whole and "),
        ("header.long_stop <= head_whole and ", "header.long_stop <= "),
        (
            "(head_kind(is_stop) or head_kind(is_reset)) and head_kind(is_clear);",
            "(head_kind(is_stop) or head_kind(is_reset));",
        ),
        ("header.stop <= head_whole and head_last and ", "header.stop <= head_whole and "),
        ("and head_last and head_kind(is_stop) and head_kind(is_clear);", "and head_last and head_kind(is_stop);"),
        (
            "not head_last and (head_kind(is_stop) or head_kind(is_reset)) and",
            "not head_last and head_kind(is_stop) and",
        ),
        (
            "not head_last and (head_kind(is_stop) or head_kind(is_reset)) and",
            "not head_last and head_kind(is_reset) and",
        ),
        // What is taken is what was held before it.
        ("going <= header;", "if head_valid = '0' then\n        going <= header;\n      end if;"),
        ("not occupied and not pending;", "not occupied;"),
        ("(head_valid and gathers and not pending)", "(head_valid and gathers)"),
        ("job_short <= short_pending;", "job_short <= short;"),
        // Soft resets: by a word that waits, that has bits which mean nothing, that leaves a job or a pair; by the port, with
        // packets that go on or words that are held.
        ("(header.soft_reset or (not occupied", "((not occupied and not waits and header.soft_reset) or (not occupied"),
        ("head_kind(is_reset) and head_kind(is_clear);", "head_kind(is_reset);"),
        ("if (reset_taken and not soft_reset) = '1' then", "if reset_taken = '1' then"),
        ("clears <= reset or soft_reset or reset_taken;", "clears <= reset or soft_reset;"),
        ("clears <= reset or soft_reset or reset_taken;", "clears <= reset or reset_taken;"),
        ("not (soft_reset and stays_within) or reset;", "not (soft_reset and within_packet) or reset;"),
        ("not (soft_reset and stays_within) or reset;", "not stays_within or reset;"),
        ("if (reset or soft_reset) = '1' then", "if reset = '1' then"),
        (
            "        pending <= '0';\n        closing <= '0';\n        goes <= '0';\n        query_pending <= '0';\n        posed_pending <= '0';\n        fault <= fine;",
            "        fault <= fine;",
        ),
        (
            "        fault <= fine;\n        gathers <= '0';\n        occupied <= '0';\n        moving <= '0';\n        stop <=",
            "        fault <= fine;\n        stop <=",
        ),
        ("(at_options and not head_kind(is_options)) or ", ""),
        ("(at_record and head(31)) or ", ""),
        (" or (at_rows and not head_kind(is_row));", ";"),
        ("answer_short := going.short;", "answer_short := '0';"),
        (
            "if at_rows = '1' then\n              found := too_long;",
            "if at_rows = '0' and at_record = '1' then\n              found := too_long;",
        ),
        ("elsif behind = '1' then", "elsif behind = '1' and whole = '0' then"),
        ("load_line <= load_line + 1;", "load_line <= load_line;"),
        ("load_line(load_line_bits) <= '1';", "load_line(load_line_bits) <= '0';"),
        ("if head_last = '1' and load_place /= 7 then", "if head_last = '1' and load_place = 0 then"),
        ("if place = row_word - 2 then", "if place = row_word - 3 then"),
    ];
    tried(&small(Memory::BlockRam), "engine_command", &changes, command);
}
