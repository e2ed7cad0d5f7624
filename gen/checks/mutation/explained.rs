//! Survivors and why they survive: most are equivalent, some differ where no vector of reasonable number looks.

use efsat_unit::design::exact::cascade::SECOND_STAGE;
use efsat_unit::params::Params;

/// A survivor and its explanation.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Name of the mutant; `*` stands for any text.
    pub pattern: &'static str,
    /// What is said of it.
    pub claim: Claim,
    /// Why it survives.
    pub reason: &'static str,
    /// In which designs.
    pub rate: Rate,
}

/// The designs of which an explanation is true, by their clocks per pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// All.
    Any,
    /// Those with one clock per pair.
    One,
    /// Those with several.
    Several,
}

/// What is said of a survivor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// No input whatever tells it from the original; it does not count, and must never be killed.
    Equivalent,
    /// Some input does, but hardly any: it counts as not killed, and may be killed by luck.
    Hidden,
}

/// A mutant that is equivalent.
const fn same(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { pattern, claim: Claim::Equivalent, reason, rate: Rate::Any }
}

/// A mutant that is equivalent where a pair takes several clocks.
const fn same_in_several(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { rate: Rate::Several, ..same(pattern, reason) }
}

/// A mutant that is equivalent where a pair takes one clock.
const fn same_in_one(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { rate: Rate::One, ..same(pattern, reason) }
}

/// A mutant that hardly any input shows where a pair takes several clocks.
const fn hidden_in_several(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { rate: Rate::Several, ..hidden(pattern, reason) }
}

/// A mutant that hardly any input shows.
const fn hidden(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { pattern, claim: Claim::Hidden, reason, rate: Rate::Any }
}

const AT_BOUND: &str = "the two differ where the number is the bound itself, and both arms give the bound";
const BELOW: &str = "a lower bound is never above, and an upper bound never below, what the true value can be";
const LATER: &str = "all of triangle A, and B from its second vertex on, is first read some clocks after it is taken";
const ORIGIN: &str = "V0 is the origin: all its lower bounds are 0";
const POSE: &str = "a pose becomes active at the end of a slot, and is first read at the end of phase 0";
const IDLE: &str = "the bypass changes between slots only, and there the row is idle for two clocks";
const STEADY: &str = "the input stands still for a slot, and the result is read after it has settled";
const HELD: &str = "the input is held for a slot, and the copy is read in the clock in which it equals the original";
const UNUSED: &str = "most designs do not call this function for values of this type";
const POPPED: &str = "valid counts in the last phase only, ten clocks or more after the last pop, and after reset";
const ROOM: &str =
    "the next push writes the place again, and never do pairs wait in all places: one is popped in every slot";
const IN_TIME: &str = "a pair is loaded a clock after it was seen to wait, and the pointer has stood still for longer";
const NOT_YET: &str = "in the clock after reset nothing is accepted and no pair is held, and then it is set anew";
const AFTER_RESET: &str = "shows in the first clock after a reset alone; `protocol::` asks there";
const SETTLED: &str = "only in slots of two clocks is the pointer read in the clock after it moves";
const NOT_ACCEPTED: &str = "after reset nothing has been accepted, and either flag says that a place is free";
const HALF: &str = "half of all counts: to add it is to subtract it";
const STANDS: &str = "the pointer stands still in the clocks before a pair is accepted";
const FROM_RESET: &str = "vectors begin with a pose; `protocol::` asks for the bypass after a reset";
const NOT_MOVED: &str = "after reset nothing has been taken, and either flag says that the queue is empty";
const PRODUCT: &str = "the factors of a product exchanged";
const ANY: &str = "any of some flags, in any order";
const RESTS: &str = "what selects moves on where no pair is, too, and nobody reads what is selected there";
const TWICE: &str = "the first vertex comes once more, so that the word of magnitudes may lose it once";
const SELECTS_ZERO: &str =
    "what it lets select is 0 in the clock before a pair and in the last two, so it may begin and end a clock early";
const NONE_YET: &str = "after reset nothing has been accepted, and the other flag is selected";
const NEARLY: &str = "shows only where the gap between boxes is one or a few units of the last place";
const ALWAYS: &str = "the flag is the constant 1";

/// Mutants of the generated VHDL.
const VHDL: &[Explanation] = &[
    hidden("efsat_types:choose:case:'1' -> '0'", UNUSED),
    hidden("efsat_types:choose:operand:condition -> if_set", UNUSED),
    hidden("efsat_types:choose:operand:if_set -> condition", UNUSED),
    hidden("efsat_types:choose:operand:if_clear -> if_set", UNUSED),
    hidden("efsat_types:choose:* #3", UNUSED),
    same("sequencer:taken_turned:operand:+ -> -", HALF),
    hidden("sequencer:running:constant:'0' -> '1'", AFTER_RESET),
    hidden("sequencer:running:delay:a register too many", AFTER_RESET),
    same_in_one("sequencer:full_if_moved:constant:'0' -> '1'", NONE_YET),
    same_in_one("sequencer:full_if_still:constant:'0' -> '1'", NOT_YET),
    same_in_one("sequencer:accepted_moved:constant:'0' -> '1'", NOT_ACCEPTED),
    hidden_in_several("sequencer:accepts:constant:'0' -> '1'", AFTER_RESET),
    hidden_in_several("sequencer:accepted:delay:a register too many", SETTLED),
    same_in_several("sequencer:decide_phase:constant:'0' -> '1'", NOT_YET),
    same_in_several("sequencer:last_phase:constant:'0' -> '1'", NOT_YET),
    same_in_several("sequencer:load_pair:constant:'1' -> '0'", NOT_YET),
    same_in_several("efsat:tag_address:delay:a register too many", STANDS),
    hidden("efsat:active_bypass:constant:'1' -> '0'", FROM_RESET),
    hidden("sequencer:takes_pose:constant:'0' -> '1'", AFTER_RESET),
    hidden("sequencer:pose_load:constant:'0' -> '1'", AFTER_RESET),
    same("sequencer:empty_if_moved:constant:'1' -> '0'", NOT_MOVED),
    same("sequencer:taken_moved:constant:'0' -> '1'", NOT_MOVED),
    same("open_pointers:empty:*:empty_if_moved -> *", POPPED),
    same("open_pointers:valid:operand:empty -> empty_if_still", POPPED),
    same("open_pointers:empty_if_moved:*", POPPED),
    same("open_pointers:empty_if_still:constant:*", POPPED),
    same("open_pointers:popped_moved:constant:*", POPPED),
    same("open_pointers:popped_moved:delay:*", POPPED),
    same("exact_stage:open_*_words:case:without the condition push*", ROOM),
    same("exact_stage:oldest:delay:a register too many", IN_TIME),
    same("transform_row:*:delay:bypass_*", IDLE),
    same("transform_row:bypass_*:delay:a register too many", IDLE),
    same("transform_row:b*.hi:delay:b_hi_aligned_not_line* -> *", IDLE),
    same("transform_row:b_hi_aligned_not_line:delay:a register too many", IDLE),
    same("renormalise_shift:*:delay:*_d1 -> *", STEADY),
    same("cross_product:l_*saturated*:comparison:* -> <=", AT_BOUND),
    same("cross_product:l_saturated.lo:case:to_signed(* -> *, the next arm", BELOW),
    same("cross_product:l_saturated.lo:constant:exact_lo_floor_6(i) -> (0)", BELOW),
    same("cross_product:l_saturated.lo:constant:65536 -> 65537", BELOW),
    same("cross_product:l_saturated.hi:case:to_signed(-* -> *, always", BELOW),
    same("cross_product:l_saturated.hi:constant:65536 -> 65537 #2", BELOW),
    same("cross_product:l_lo_saturated_too_high_d1:delay:*", BELOW),
    same("cross_product:l_lo_saturated_too_high_d1:constant:*", BELOW),
    same("cross_product:l_hi_saturated_raised_too_low_d1:delay:*", BELOW),
    same("cross_product:l_hi_saturated_raised_too_low_d1:constant:*", BELOW),
    same_in_several("pair_pipeline:axis0_has_b2_at_0_table:constant:entry 0: 0 -> 1", TWICE),
    same_in_several("pair_points:in_phase_1:comparison:= -> /=", SELECTS_ZERO),
    same_in_several("efsat:pair_v:delay:a register too many*", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #4", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #5", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #6", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #7", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #8", LATER),
    same_in_several("efsat:pair_w:delay:a register too many #9", LATER),
    hidden(
        "inner_side:up:constant:plane_b(*) -> (0)",
        "shows where no edge pierces, and one corner in the plane alone is outside one edge: hardly any pair",
    ),
    hidden(
        "first_point:first_choice_d1:operand:*",
        "shows where one of two corners alone is V0, and the lines cross there",
    ),
    hidden("pair_witnesses:boxes_wrong_table:constant:entry 0: 1 -> 2", NEARLY),
    hidden(
        "pair_witnesses:boxes_wrong_d1:delay:a register too many",
        "shows only where such a gap is a few units of the last place, and the pair before has another level",
    ),
    same_in_several("pair_coordinates:shift_unit_x:delay:difference_v*_h9 -> difference_v*_held(3)", HELD),
    same("pair_axes:p_unit_v.lo:constant:v(0)(i) -> (0)", ORIGIN),
    same_in_several("*:case:without the condition busy_*", RESTS),
    same_in_several("efsat:active_*:delay:a register too many*", POSE),
    same_in_one("efsat:pair_v:case:without the condition*", "what is not accepted is computed, but not taken over"),
    same_in_one("efsat:pair_w:case:without the condition*", "what is not accepted is computed, but not taken over"),
    hidden(
        "efsat:path.pose_*:delay:active_* -> next_*",
        "a pose accepted in the clock of a pair is not for that pair: the vectors send one after the other, and the test \
         protocol:: sends both at once",
    ),
    same("coordinate_carry:carried:operand:sign dropped", "R and -R are one word in as many bits"),
    same("dot_product:product_unit.*:operand:x(i) and m(i)*", PRODUCT),
    same_in_several("bound_tails:w_d1:delay:a register too many", STEADY),
    same("certain_sign:sign:constant:sign1_sum(41) -> (40)", "the sum has a sign bit more than it needs"),
    same("edge_verdict:missed*:operand:sides(*) and sides(*) exchanged", ANY),
    same("box_axis:*_word_any_d1:operand:* exchanged", ANY),
    same("comparator_network:not_all_*:operand:* exchanged", ANY),
    same("comparator_network:some_*:operand:* exchanged", ANY),
    same("inner_side:inner:operand:(* exchanged", ANY),
    same("exact_sign:sign_i:constant:x(59) -> (58)", "the number has sign bits more than it needs"),
    same("first_point:*_any*:operand:* exchanged", ANY),
    same("cross_component:c_result_*_unit.x:operand:* and *(1)", PRODUCT),
    same("left_out_coordinate:seen:operand:not flag(* exchanged", ANY),
    same("pair_plane:no_u:operand:not flag(* exchanged", ANY),
    same("pair_plane:moment_c:constant:moment_*_h1(0) -> (1)", "of pairs on two lines, whose moments are all 0"),
    same("pair_plane:v_in_plane_unit.left_out:operand:left_out_* and left_out_*", "the two are one signal"),
    hidden(
        "pair_verdict:in_plane:constant:planes(1) -> (0) #2",
        "shows where the middle corner of a segment is off the plane, and its end, given twice, on it: hardly any pair",
    ),
    same("pair_witnesses:skew_word_h1:operand:* exchanged", ANY),
    same("pair_verdict:both_sides:operand:planes(*) and planes(*) exchanged", ANY),
    hidden(
        "moment_component:high_*:rounding:ulp dropped",
        "a moment within half a unit of the place where it no longer fits: one of half a million",
    ),
    same("projection:p.hi:rounding:ulp forced", ALWAYS),
];

/// Mutants of the first stage of a cascade whose differences it takes whole (docs/cascade.md, section 2).
const WHOLE: &[Explanation] = &[same(
    "coordinate_round:y_floor_1_sum:rounding:ulp dropped",
    "no bit that is rounded off is ever set in so few bits",
)];

/// Explanations that are true of a design.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// By the names of mutants.
    pub all: Vec<&'static Explanation>,
    /// Of a second stage, by names without the prefix of its units.
    pub second: Vec<&'static Explanation>,
}

impl Table {
    /// The explanation of a mutant.
    pub fn find(&self, name: &str) -> Option<&'static Explanation> {
        let of = |table: &[&'static Explanation], name: &str| {
            table.iter().find(|explanation| matches(explanation.pattern, name)).copied()
        };
        let second = name.strip_prefix(SECOND_STAGE).and_then(|name| of(&self.second, name));
        second.or_else(|| of(&self.all, name))
    }
}

/// The explanations that are true of a design's VHDL.
pub fn vhdl(params: &Params) -> Table {
    let at = |clocks: usize| -> Vec<&Explanation> {
        let rate = if clocks == 1 { Rate::One } else { Rate::Several };
        VHDL.iter().filter(|explanation| [Rate::Any, rate].contains(&explanation.rate)).collect()
    };
    let is_whole = params.first_stage().is_some_and(|first| params.width <= first.width);
    let all = at(params.interval()).into_iter().chain(WHOLE.iter().filter(|_| is_whole)).collect();
    let second = params.exact_clocks.map(|clocks| at(clocks as usize));
    Table { all, second: second.unwrap_or_default() }
}

/// Whether a name has the form of a pattern in which `*` stands for any text.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((head, tail)) => {
            let Some(rest) = name.strip_prefix(head) else { return false };
            (0..=rest.len()).any(|i| rest.is_char_boundary(i) && matches(tail, &rest[i..]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_unit::params::Method;

    #[test]
    fn a_star_stands_for_any_text() {
        assert!(matches("a:*_lo:case", "a:x_lo:case") && matches("*", "") && matches("a*b*c", "a-b-c"));
        assert!(!matches("a:*_lo", "a:x_lo:case") && !matches("a", "b") && !matches("a*b", "a"));
    }

    #[test]
    fn units_of_a_second_stage_have_the_explanations_of_their_rate() {
        let single = Params::of(Method::Exact);
        let cascade = Params { exact_clocks: Some(16), ..single.clone() };
        let found = |params: &Params, name: &str| vhdl(params).find(name).is_some();
        let any = "left_out_coordinate:seen:operand:not flag(x) exchanged";
        let several = "sequencer:last_phase:constant:'0' -> '1'";
        assert!(found(&single, any) && found(&cascade, any) && found(&cascade, &format!("exact_{any}")));
        assert!(!found(&single, &format!("exact_{any}")));
        assert!(!found(&cascade, several) && found(&cascade, &format!("exact_{several}")));
        let rounding = "coordinate_round:y_floor_1_sum:rounding:ulp dropped";
        let wide = Params { width: 19, ..cascade.clone() };
        let rounds = [&cascade, &wide, &Params::of(Method::Determinants)].map(|params| found(params, rounding));
        assert_eq!(rounds, [true, false, false]);
    }
}
