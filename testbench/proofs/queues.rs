//! Queues, for all time: every pair is answered once, in order, and within a stated number of clocks. Of the queue of answers
//! of any unit, with the printed control; and of the second stage of a cascade, with a stub in place of its data path.
//!
//! Control reads nothing of what the data path computes. So a pair is given its own number as data, and the claim says where
//! in the stage each number is. It holds at the start and after a clock if it held before it (induction with one step), so it
//! holds for all time, whatever comes in. What is assumed of the unit around the stage is what docs/cascade.md says of it.

use super::invariant::Invariant;
use super::unit::Mistake::{Inverted, NotMissing, WrongArm, WrongGate};
use efsat::design::{Design, Probes};
use efsat::params::Params;
use efsat::vhdl;
use std::fmt::Write;

/// Name of the package of types.
const PACKAGE: &str = "efsat_types";

/// A cascade and what its claims need to know of it.
pub struct Cascade {
    files: Vec<(String, String)>,
    params: Params,
    places: usize,
    /// Bits of a number of a pair: twice the places.
    bits: u32,
    /// Clocks of the second data path.
    latency: usize,
    /// Clocks of a slot of the second stage.
    slot: usize,
}

/// Places of the result queue of the second stage.
const PLACES: usize = 16;

impl Cascade {
    pub fn new(params: &Params) -> Self {
        let design = Design::new(params, Probes::None).unwrap_or_else(|e| panic!("{params:?}: {e}"));
        let stage = design.second.as_ref().expect("a cascade");
        Self {
            files: vhdl::print(&design.top, "", PACKAGE, &[]).expect("legal names"),
            params: params.clone(),
            places: design.places,
            bits: design.places.trailing_zeros() + 1,
            latency: stage.schedule.latency as usize,
            slot: stage.pipeline.interval,
        }
    }

    fn text(&self, name: &str) -> &str {
        &self.files.iter().find(|(file, _)| file == name).unwrap_or_else(|| panic!("no file {name}")).1
    }

    /// Printed files by their names, and entities with another architecture than the printed one.
    fn sources(&self, printed: &[&str], stubs: &[(&str, String)], last: &str) -> Vec<(String, String)> {
        let stub = |(name, architecture): &(&str, String)| {
            let (entity, _) = self.text(name).split_once("architecture rtl").expect("an architecture");
            (
                format!("{name}.vhd"),
                format!("{entity}architecture rtl of {name} is\n{architecture}end architecture rtl;\n"),
            )
        };
        let whole = |name: &&str| (format!("{name}.vhd"), self.text(name).to_owned());
        let printed = [PACKAGE].iter().chain(printed).map(whole);
        printed.chain(stubs.iter().map(stub)).chain([whole(&last)]).collect()
    }

    fn claim(&self, entity: &'static str, property: &'static str, files: Vec<(String, String)>) -> Invariant {
        let sizes = format!("{} places, {} clocks", self.places, self.slot);
        Invariant::new(entity, property, sizes, files)
    }

    /// Clocks within which the second stage offers the answer of its oldest pair.
    fn patience(&self) -> usize {
        self.latency + 2 * self.slot + 4
    }

    /// The second stage: the n-th answer is that of the n-th pair, if never more pairs are pushed than there are places.
    pub fn second_stage(&self) -> Invariant {
        let Self { places, bits: w, latency, slot, .. } = *self;
        let (top, ages) = (w - 1, latency / slot + 1);
        let files =
            self.sources(&["open_pointers", "exact_sequencer"], &[("exact_pipeline", self.stub())], "exact_stage");
        let mut claim = self.claim("exact_stage", "answers in order, none lost, each in time", files);
        self.look(&mut claim);
        claim.given = vec![format!("!push || in_use < {places}"), "!take || out_valid".to_owned()];
        self.counters(&mut claim);
        let holds: Vec<String> = (0..ages - 1).map(|age| format!("control_holds[{age}]")).collect();
        let in_path = holds.iter().map(String::as_str).chain(["in_last"]).collect::<Vec<_>>();
        claim.shown([format!("in_path == {}", in_path.join(" + "))]);
        // What is read of the queue is its oldest pair by the time when it may be taken.
        claim.shown(["!queue_popped_moved || control_phase_i == 0"]);
        claim.shown(["!queue_valid || queue_popped_moved || read == queue_popped"]);
        // What is offered stays until it is taken, and is the answer of the oldest pair.
        claim.shown(["out_valid == control_offered", "!kept || out_valid", "!out_valid || outstanding"]);
        claim.shown(["!out_valid || out_word[9:1] == consumed && out_word[18:10] == consumed"]);
        // Where each pair is: in the data path, in the queue before it, or in the queue behind it.
        for clock in 0..=latency {
            let (age, phase) = (clock / slot, clock % slot);
            let at = match clock {
                0 => "path_payload".to_owned(),
                _ => format!("path_stages[{} +: {w}]", w as usize * (latency - clock)),
            };
            let _ = writeln!(
                claim.body,
                "  wire [{top}:0] number{clock} = {};",
                [&["newest".to_owned()], &holds[..age]].concat().join(" - ")
            );
            claim.shown([format!("control_phase_i != {phase} || !control_holds[{age}] || {at} == number{clock}")]);
        }
        place_numbers(&mut claim.body, places, w, "open", "queue_popped", "queue_popped");
        claim.shown(
            (0..places).map(|i| format!("open{i} >= waiting || open_fitted0_x_words{i}[{top}:0] == open_number{i}")),
        );
        let _ = writeln!(claim.body, "  wire [{top}:0] first = consumed + control_offered;");
        place_numbers(&mut claim.body, PLACES, w, "result", "control_taken", "first");
        claim.shown((0..PLACES).map(|i| {
            let word = format!("result_queue_words{i}");
            format!("result{i} >= done || {word}[9:1] == result_number{i} && {word}[18:10] == result_number{i}")
        }));
        self.bound(&mut claim, &holds);
        claim.mutants(&[
            (WrongGate, "take_pair"),
            (WrongGate, "accept_pair"),
            (WrongArm, "empty"),
            (WrongGate, "decide_pair"),
            (Inverted, "valid"),
            (NotMissing, "output_free"),
            (Inverted, "full"),
        ]);
        claim
    }

    /// A data path that answers in one clock only, with what it was given in phase 0.
    fn stub(&self) -> String {
        let Self { bits: w, latency, .. } = *self;
        let top = w - 1;
        format!(
            "  type stages_t is array (1 to {latency}) of unsigned({top} downto 0);
  signal stages : stages_t := (others => (others => '0'));
  signal payload : unsigned({top} downto 0);
begin
  payload <= unsigned(fitted(0)(0)({top} downto 0));
  delay : process (clk)
  begin
    if rising_edge(clk) then
      if phase = 0 then
        stages(1) <= payload;
      else
        stages(1) <= not payload;
      end if;
      stages(2 to {latency}) <= stages(1 to {last});
    end if;
  end process delay;
  verdict <= '0';
  separated <= std_logic_vector(resize(stages({latency}), 9));
  overlapping <= std_logic_vector(resize(stages({latency}), 9));
",
            last = latency - 1
        )
    }

    /// What the claim looks at, and the counts that follow from it.
    fn look(&self, claim: &mut Invariant) {
        let Self { places, bits: w, latency, slot, .. } = *self;
        let (top, width, ages) = (w - 1, self.params.width, latency / slot + 1);
        claim.inputs = vec!["push", "take"];
        let pointer = PLACES.trailing_zeros() + 1;
        let phase = slot.next_power_of_two().trailing_zeros();
        claim.see(&[("queue.pushed", w), ("queue.popped", w), ("queue.popped_ahead", w), ("queue_valid", 1)]);
        claim.see(&[("queue.popped_moved", 1), ("oldest", 15 * width)]);
        claim.see(&[("control.accepted", pointer), ("control.decided", pointer)]);
        claim.see(&[("control.taken", pointer), ("control.taken_ahead", pointer)]);
        claim.see(&[("control.accepts", 1), ("control.phase_i", phase), ("control.last_phase", 1)]);
        claim.see(&[("control.offered_in_time", 1)]);
        claim.see(&[("control.decide_phase", 1), ("control.empty", 1), ("control.offered", 1)]);
        claim.see(&[("control.holds", ages as u32), ("path.stages", w * latency as u32), ("path.payload", w)]);
        claim.words = vec![("open_fitted0_x_words", places, width), ("result_queue_words", PLACES, 19)];
        claim.ports =
            [".push(push)", ".take(take)", ".out_valid(out_valid)", ".out_word(out_word)"].map(str::to_owned).into();
        claim.ports.push(format!(".fitted({{{}'b0, queue_pushed, {}'b0}})", width - w, 14 * width));
        let _ = write!(
            claim.body,
            "  wire out_valid; wire [18:0] out_word;
  reg [{top}:0] consumed = 0, pushed_prev = 0; reg [{p}:0] taken_prev = 0, decided_prev = 0; reg kept = 0; reg [9:0] waited = 0;
  wire outstanding = consumed != queue_pushed;
  always @(posedge clk)
    if (reset) begin
      consumed <= 0; pushed_prev <= 0; taken_prev <= 0; decided_prev <= 0; kept <= 0; waited <= 0;
    end else begin
      if (take) consumed <= consumed + 1;
      pushed_prev <= queue_pushed; taken_prev <= control_taken; decided_prev <= control_decided;
      kept <= out_valid && !take;
      waited <= outstanding && !out_valid ? waited + 1 : 0;
    end
  wire [{top}:0] in_use = queue_pushed - consumed, begun = queue_popped - consumed, waiting = queue_pushed - queue_popped;
  wire [{top}:0] ahead = queue_popped_ahead - queue_popped, pushed_lag = queue_pushed - pushed_prev;
  wire [{top}:0] visible = pushed_prev - queue_popped, newest = queue_popped - 1;
  wire [{p}:0] inside = control_accepted - control_taken, done = control_decided - control_taken;
  wire [{p}:0] in_path = control_accepted - control_decided, full_at = taken_prev + {PLACES}, given = control_taken - control_offered;
  wire [{p}:0] taken_ahead = control_taken_ahead - control_taken;
  wire [{p}:0] taken_lag = control_taken - taken_prev, decided_lag = control_decided - decided_prev, seen = decided_prev - control_taken;
  wire [{top}:0] read = oldest[{low} +: {w}];
  wire in_last = control_holds[{old}] && control_phase_i <= {decides};
",
            p = pointer - 1,
            old = ages - 1,
            low = 14 * width,
            decides = latency % slot,
        );
    }

    /// How the counters of the stage stand to each other.
    fn counters(&self, claim: &mut Invariant) {
        let Self { places, bits: w, latency, slot, .. } = *self;
        let pointer = PLACES.trailing_zeros() + 1;
        claim.shown(["ahead == 1", "taken_ahead == 1", "begun <= in_use", "pushed_lag <= 1"]);
        claim.shown(["taken_lag <= 1", "decided_lag <= 1", "visible <= waiting", "seen <= done", "done <= inside"]);
        claim.shown([
            format!("in_use <= {places}"),
            format!("inside <= {PLACES}"),
            format!("inside + taken_lag <= {PLACES}"),
        ]);
        let low = pointer.min(w) - 1;
        claim.shown([
            format!("queue_popped[{low}:0] == control_accepted[{low}:0]"),
            format!("consumed[{low}:0] == given[{low}:0]"),
        ]);
        claim.shown(["begun == inside + control_offered", "queue_valid == (queue_popped != pushed_prev)"]);
        claim.shown([
            "control_accepts == (control_last_phase && control_accepted != full_at)",
            "control_empty == (control_taken == decided_prev)",
        ]);
        claim.shown([
            format!("control_phase_i < {slot}"),
            format!("control_last_phase == (control_phase_i == {})", slot - 1),
            format!("!control_decide_phase || control_phase_i == {}", latency % slot),
            format!("control_decide_phase || control_phase_i != {} || control_holds == 0", latency % slot),
            "!control_offered_in_time || (control_last_phase && queue_valid)".to_owned(),
        ]);
    }

    /// Clocks until the oldest answer is offered; they pass one by one.
    fn bound(&self, claim: &mut Invariant, holds: &[String]) {
        let Self { latency, slot, .. } = *self;
        let ages = latency / slot + 1;
        let mut remaining = "out_valid || !outstanding ? 0 : done != 0 ? 1 + control_empty".to_owned();
        let oldest = latency + 3;
        for age in (0..ages).rev() {
            let held = if age + 1 == ages { "in_last".to_owned() } else { holds[age].clone() };
            let _ = write!(remaining, " : {held} ? {} - control_phase_i", oldest - slot * age);
        }
        let _ = write!(remaining, " : {} - control_phase_i", oldest + slot);
        // Looked at a clock before the last phase.
        let late = format!(
            "control_phase_i == {} && !queue_valid || control_phase_i == {} && !control_offered_in_time",
            slot - 2,
            slot - 1
        );
        let _ = write!(remaining, " + ({late} ? {slot} : 0)");
        let _ = writeln!(claim.body, "  wire [9:0] remaining = {remaining};");
        claim.shown([format!("waited + remaining <= {}", self.patience())]);
    }
}

/// The queue of answers of a unit, in the first stage of a cascade: no pair is accepted without a place, the pairs are decided
/// and taken in the order in which they were accepted, and the oldest is taken in time if nothing holds it up.
pub fn answers(params: &Params) -> Invariant {
    let design = Design::new(params, Probes::None).unwrap_or_else(|e| panic!("{params:?}: {e}"));
    let files = vhdl::print(&design.top, "", PACKAGE, &[]).expect("legal names");
    let text = |name: &str| files.iter().find(|(file, _)| file == name).expect("an entity of every unit").1.clone();
    let (places, slot, latency) = (design.places, design.interval, design.schedule.latency as usize);
    let w = places.trailing_zeros() + 1;
    let control = text("sequencer");
    let inputs = ["in_valid", "out_ready", "head_ready", "pose_valid"].into_iter();
    let inputs: Vec<&str> = inputs.filter(|name| control.contains(&format!("{name} "))).collect();
    let able = if inputs.contains(&"head_ready") { "head_ready && output_free" } else { "output_free" };
    let outputs = ["accept", "decide", "take", "out_valid", "accept_address", "decide_address", "take_address"];
    let sizes = format!("{places} places, {slot} clock{}", if slot == 1 { "" } else { "s" });
    let files = [PACKAGE, "sequencer"].map(|name| (format!("{name}.vhd"), text(name))).into();
    let mut claim = Invariant::new("sequencer", "answers in order, none lost, each in time", sizes, files);
    claim.ports = inputs.iter().chain(&outputs).map(|name| format!(".{name}({name})")).collect();
    claim.inputs = inputs;
    claim.see(&[("accepted", w), ("decided", w), ("taken", w), ("taken_ahead", w), ("empty", 1), ("output_free", 1)]);
    let (in_path, oldest) = in_data_path(&mut claim, latency, slot);
    let _ = write!(
        claim.body,
        "  wire accept, decide, take, out_valid; wire [{a}:0] accept_address, decide_address, take_address;
  reg [{p}:0] taken_prev = 0, decided_prev = 0; reg kept = 0; reg [9:0] waited = 0;
  wire [{p}:0] inside = accepted - taken, done = decided - taken, in_path = accepted - decided, full_at = taken_prev + {places};
  wire [{p}:0] taken_lag = taken - taken_prev, decided_lag = decided - decided_prev, seen = decided_prev - taken;
  wire [{p}:0] taken_next = taken_ahead - taken;
  wire [9:0] remaining = done != 0 ? empty : {oldest};
  always @(posedge clk)
    if (reset) begin
      taken_prev <= 0; decided_prev <= 0; kept <= 0; waited <= 0;
    end else begin
      taken_prev <= taken; decided_prev <= decided; kept <= out_valid && !out_ready;
      waited <= {able} && !take && inside != 0 ? waited + 1 : 0;
    end
",
        a = w - 2,
        p = w - 1,
    );
    claim.shown(["taken_next == 1", "taken_lag <= 1", "decided_lag <= 1", "seen <= done"]);
    claim.shown(["empty == (taken == decided_prev)", "done <= inside"]);
    if slot == 1 {
        claim.see(&[("accepted_ahead", w), ("full", 1)]);
        let _ = writeln!(claim.body, "  wire [{}:0] accepted_next = accepted_ahead - accepted;", w - 1);
        claim.shown(["accepted_next == 1", "full == (accepted == full_at)"]);
        claim.mutants(&[(WrongGate, "accepts"), (WrongArm, "full")]);
    } else {
        claim.see(&[("accepts", 1)]);
        claim.shown(["accepts == (last_phase && accepted != full_at)"]);
        claim.mutants(&[(Inverted, "full"), (Inverted, "phase_equal")]);
    }
    claim.shown([format!("inside <= {places}"), format!("inside + taken_lag <= {places}")]);
    claim.shown([format!("in_path == {in_path}"), format!("!accept || inside < {places}")]);
    claim.shown(["!decide || in_path != 0", "!take || done != 0", "!kept || out_valid"]);
    claim.shown(
        [("accept", "accepted"), ("decide", "decided"), ("take", "taken")]
            .map(|(word, count)| format!("{word}_address == {count}[{}:0]", w - 2)),
    );
    claim.shown([format!("waited + remaining <= {}", latency + 3)]);
    claim.mutants(&[(WrongArm, "empty"), (NotMissing, "output_free")]);
    claim.mutants(&[(WrongGate, "accept_pair"), (WrongGate, "take_pair")]);
    claim
}

/// What the claim about a sequencer says of the pairs in the data path: how many there are, and in how many clocks the oldest
/// can be taken.
fn in_data_path(claim: &mut Invariant, latency: usize, slot: usize) -> (String, String) {
    if slot == 1 {
        claim.see(&[("holds", latency as u32), ("decide_pair", 1)]);
        let holds = (0..latency).rev().map(|age| (format!("holds[{age}]"), latency - age + 2));
        let pairs: Vec<(String, usize)> = std::iter::once(("decide_pair".to_owned(), 2)).chain(holds).collect();
        let names: Vec<&str> = pairs.iter().map(|(name, _)| name.as_str()).collect();
        let clocks: String = pairs.iter().map(|(name, clocks)| format!("{name} ? {clocks} : ")).collect();
        return (names.join(" + "), clocks + "0");
    }
    let (ages, decides) = (latency / slot + 1, latency % slot);
    let phase = slot.next_power_of_two().trailing_zeros();
    claim.see(&[("phase_i", phase), ("last_phase", 1), ("decide_phase", 1), ("holds", ages as u32)]);
    let _ = writeln!(claim.body, "  wire in_last = holds[{}] && phase_i <= {decides};", ages - 1);
    claim.shown([
        format!("phase_i < {slot}"),
        format!("last_phase == (phase_i == {})", slot - 1),
        format!("!decide_phase || phase_i == {decides}"),
        format!("decide_phase || phase_i != {decides} || holds == 0"),
    ]);
    let name = |age: usize| if age + 1 == ages { "in_last".to_owned() } else { format!("holds[{age}]") };
    let names: Vec<String> = (0..ages).map(name).collect();
    let clocks = |age: usize| format!("{} ? {} - phase_i : ", name(age), latency + 2 - slot * age);
    (names.join(" + "), (0..ages).rev().map(clocks).collect::<String>() + "0")
}

/// Of each place of a queue: how far it is from the oldest one, and the number of the pair that is there.
fn place_numbers(body: &mut String, places: usize, bits: u32, name: &str, pointer: &str, first: &str) {
    let address = places.trailing_zeros();
    for i in 0..places {
        let _ = writeln!(
            body,
            "  wire [{}:0] {name}{i} = {address}'d{i} - {pointer}[{}:0]; wire [{}:0] {name}_number{i} = {first} + {name}{i};",
            address - 1,
            address - 1,
            bits - 1
        );
    }
}
