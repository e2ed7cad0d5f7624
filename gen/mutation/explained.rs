//! Equivalent mutants: what survives, and why no input whatever can tell it from the original.

/// A survivor and its explanation.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Name of the mutant; `*` stands for any text.
    pub pattern: &'static str,
    /// Why it is equivalent.
    pub reason: &'static str,
}

const EQUAL: &str = "of two equal numbers either is the least and the greatest";
const ZERO: &str = "the two differ where the factor is 0, and 0 times either bound is 0";
const AT_BOUND: &str = "the two differ where the number is the bound itself, and both arms give the bound";
const NARROW: &str = "entries of M and coordinates are at most one ulp wide, so no factor of the transform straddles 0";
const RANGE: &str = "the proven range leaves the two top bits equal, but for one number that is its own negative there";
const DROPPED: &str = "the bit stays among those that are dropped, and floor + ulp does not look at them";
const NEVER_ZERO: &str = "an upper bound is one ulp above the lower one, so the OR of the magnitudes is never 0";
const BELOW: &str = "a lower bound is never above, and an upper bound never below, what the true value can be";
const LATER: &str = "V0 is first read some clocks after it is taken";
const SLOT: &str = "held for a slot, and first read more than a clock after it is taken";
const IDLE: &str = "the bypass changes between slots only, and there the row is idle for two clocks";
const SHIFTED: &str =
    "all points go into one OR: the lower bound that is lost is V0's own, 0, and the one that is gained \
    is the last point's again";
const STEADY: &str = "the input stands still for a slot, and the result is read after it has settled";
const UNFELT: &str =
    "moves a bound of the table by an ulp or two, and under the parameters run no format and no clamp that is \
    reached depends on it";
const OVERWRITTEN: &str = "a first value that is always overwritten";
const FASTER: &str = "decides between 64 and 128 bit only, and the sums fit 64 bits in either case";

/// Mutants of the generated VHDL.
pub const VHDL: &[Explanation] = &[
    Explanation { pattern: "*_multiply:*_wide:comparison:< -> <=", reason: EQUAL },
    Explanation { pattern: "transform_multiply:*_zero:constant:last bit of a literal -> 1", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_positive:case:not dropped", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_hi_above:comparison:< -> <=", reason: ZERO },
    Explanation { pattern: "transform_multiply:*_greatest*:*", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_least*:*", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_minus_*:*", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_takes_*_straddle:operand:*_positive -> *", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_takes_*_straddle:operand:*_negative -> *", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_takes_*_straddle:case:not *_positive", reason: NARROW },
    Explanation { pattern: "transform_multiply:*_takes_*_straddle:case:not *_negative", reason: NARROW },
    Explanation { pattern: "transform_multiply:both_straddle_d1:delay:a register too many", reason: NARROW },
    Explanation { pattern: "transform_multiply:product_lo_x_*:operand:lo_x -> lo_x_bound", reason: NARROW },
    Explanation { pattern: "transform_multiply:product_lo_y_*:operand:lo_y -> lo_y_bound", reason: NARROW },
    Explanation { pattern: "transform_multiply:product_hi_x_*:operand:hi_x -> hi_x_bound", reason: NARROW },
    Explanation { pattern: "transform_multiply:product_hi_y_*:operand:hi_y -> hi_y_bound", reason: NARROW },
    Explanation { pattern: "transform_row:b_up_inexact_d*:delay:*", reason: IDLE },
    Explanation {
        pattern: "renormalise_offset:magnitudes_*:delay:magnitude_*_lo_d1 -> magnitude_*_lo",
        reason: SHIFTED,
    },
    Explanation { pattern: "renormalise_shift:*:delay:*_d1 -> *", reason: STEADY },
    Explanation { pattern: "renormalise_scale:*:delay:shift_*_d1 -> *", reason: STEADY },
    Explanation { pattern: "sequencer:slot_*_holds:delay:a register too many", reason: SLOT },
    Explanation { pattern: "renormalise_offset:magnitude_*_bits:constant:(*", reason: RANGE },
    Explanation { pattern: "renormalise_scale:moved_*:constant:last bit of a literal -> 1", reason: DROPPED },
    Explanation { pattern: "pair_pipeline:magnitude*_zero:constant:last bit of a literal -> 1", reason: NEVER_ZERO },
    Explanation { pattern: "cross_product:*_clamp_lo:case:*_most -> *_least, the next arm", reason: BELOW },
    Explanation { pattern: "efsat:pair_v0_*:delay:a register too many", reason: LATER },
    Explanation {
        pattern: "sequencer:running:delay:a register too many",
        reason: "pose_ready rises one clock later after reset; no pose is loaded before the end of the slot either way",
    },
    Explanation { pattern: "comparator_network:a_m*:comparison:< -> <=", reason: EQUAL },
    Explanation { pattern: "comparator_network:b_m*:comparison:< -> <=", reason: EQUAL },
    Explanation { pattern: "cross_product:*_clamp_*:comparison:> -> >=", reason: AT_BOUND },
    Explanation { pattern: "cross_product:*_clamp_*:comparison:< -> <=", reason: AT_BOUND },
];

/// Mutants of the reference model.
pub const MODEL: &[Explanation] = &[
    Explanation { pattern: "golden/interval.rs:product_by:comparison:>= -> >*", reason: ZERO },
    Explanation { pattern: "golden/interval.rs:product_by:constant:0 -> 1*", reason: ZERO },
    Explanation { pattern: "golden/transform.rs:new:constant:2 -> 3", reason: FASTER },
    Explanation { pattern: "golden/transform.rs:new:comparison:<= -> <", reason: FASTER },
    Explanation { pattern: "golden/transform.rs:new:constant:62 -> 63", reason: FASTER },
    Explanation { pattern: "golden/projection.rs:images:constant:0 -> 1", reason: OVERWRITTEN },
    Explanation { pattern: "golden/projection.rs:images:constant:0 -> 1 #2", reason: OVERWRITTEN },
    Explanation { pattern: "params/mod.rs:coordinate_bound:constant:2 -> 3", reason: UNFELT },
    Explanation {
        pattern: "params/formats.rs:row:constant:1 -> 2",
        reason: "every quantity of the table reaches 1, so no format has one integral digit",
    },
    Explanation {
        pattern: "params/formats.rs:row:comparison:> -> >=",
        reason: "no bound is the greatest number of a format",
    },
    Explanation {
        pattern: "params/formats.rs:Formats:constant:0 -> 1",
        reason: "takes another name for a row, and names are for messages",
    },
];

/// The explanation of a mutant.
pub fn find(table: &'static [Explanation], name: &str) -> Option<&'static Explanation> {
    table.iter().find(|explanation| matches(explanation.pattern, name))
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

    #[test]
    fn a_star_stands_for_any_text() {
        assert!(matches("a:*_lo:case", "a:x_lo:case") && matches("*", "") && matches("a*b*c", "a-b-c"));
        assert!(!matches("a:*_lo", "a:x_lo:case") && !matches("a", "b") && !matches("a*b", "a"));
    }
}
