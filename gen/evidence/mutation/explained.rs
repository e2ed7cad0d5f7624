//! Survivors and why they survive: most are equivalent, some differ where no vector of reasonable number looks.

/// A survivor and its explanation.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Name of the mutant; `*` stands for any text.
    pub pattern: &'static str,
    /// What is said of it.
    pub claim: Claim,
    /// Why it survives.
    pub reason: &'static str,
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
    Explanation { pattern, claim: Claim::Equivalent, reason }
}

/// A mutant that hardly any input shows.
const fn hidden(pattern: &'static str, reason: &'static str) -> Explanation {
    Explanation { pattern, claim: Claim::Hidden, reason }
}

const EQUAL: &str = "of two equal numbers either is the least and the greatest";
const ZERO: &str = "the two differ where the factor is 0, and 0 times either bound is 0";
const ORIGIN: &str =
    "V0 is the origin after re-normalisation, so what separates its projection from another of A fits a bit less";
const AT_BOUND: &str = "the two differ where the number is the bound itself, and both arms give the bound";
const RANGE: &str = "the proven range leaves the two top bits equal";
const SAME_LENGTH: &str =
    "the two top bits differ in the greatest number alone, a power of two, which one more does not make longer";
const DROPPED: &str = "the bit stays among those that are dropped, and floor + ulp does not look at them";
const NEVER_ZERO: &str = "an upper bound is one ulp above the lower one, so the OR of the magnitudes is never 0";
const BELOW: &str = "a lower bound is never above, and an upper bound never below, what the true value can be";
const LATER: &str = "V0 is first read some clocks after it is taken";
const SLOT: &str = "held for a slot, and first read more than a clock after it is taken";
const IDLE: &str = "the bypass changes between slots only, and there the row is idle for two clocks";
const SHIFTED: &str = "all points go into one OR: the lower bound that is lost is V0's own, 0, and the one that is gained \
    is the last point's again";
const STEADY: &str = "the input stands still for a slot, and the result is read after it has settled";
const OVERWRITTEN: &str = "a first value that is always overwritten";
const FASTER: &str = "decides between 64 and 128 bit only, and the sums fit 64 bits in either case";

/// Mutants of the generated VHDL.
pub const VHDL: &[Explanation] = &[
    same("transform_row:*:delay:bypass_d* -> bypass*", IDLE),
    same("transform_row:bypass_d4:delay:(4) -> (3)", IDLE),
    same("transform_row:*:delay:b_up_inexact_d* -> b_up_inexact*", IDLE),
    same("renormalise_offset:magnitudes_*:delay:magnitude_*_lo_d1 -> magnitude_*_lo", SHIFTED),
    same("renormalise_shift:*:delay:*_d1 -> *", STEADY),
    same("renormalise_scale:*:delay:shift_*_d1 -> *", STEADY),
    same("sequencer:slot_*_holds:delay:a register too many", SLOT),
    same("renormalise_offset:magnitude_*_lo_bits:constant:(*", RANGE),
    same("renormalise_offset:magnitude_*_hi_bits:constant:(* #2", SAME_LENGTH),
    same("renormalise_scale:moved_*:constant:last bit of a literal -> 1", DROPPED),
    same("pair_pipeline:magnitude*_zero:constant:last bit of a literal -> 1", NEVER_ZERO),
    same("cross_product:*_clamp_lo:case:*_most -> *_least, the next arm", BELOW),
    same("cross_product:*_clamp_hi:case:*_least -> *, the next arm", BELOW),
    same("efsat:pair_v0_*:delay:a register too many", LATER),
    hidden(
        "sequencer:running:delay:a register too many",
        "pose_ready rises one clock later after reset; no pose is loaded before the end of the slot either way",
    ),
    same("comparator_network:*_order_difference:comparison:< -> <=", EQUAL),
    same("comparator_network:a_lo_order:constant:(*", ORIGIN),
    same("comparator_network:a_hi_order:constant:(*", ORIGIN),
    same("cross_product:*_clamp_*:comparison:> -> >=", AT_BOUND),
    same("cross_product:*_clamp_*:comparison:< -> <=", AT_BOUND),
];

/// Mutants of the reference model.
pub const MODEL: &[Explanation] = &[
    same("golden/interval.rs:product_by:comparison:>= -> >*", ZERO),
    same("golden/interval.rs:product_by:constant:0 -> 1*", ZERO),
    same("golden/transform.rs:new:constant:2 -> 3", FASTER),
    same("golden/transform.rs:new:comparison:<= -> <", FASTER),
    same("golden/transform.rs:new:constant:62 -> 63", FASTER),
    same("golden/projection.rs:images:constant:0 -> 1", OVERWRITTEN),
    same("golden/projection.rs:images:constant:0 -> 1 #2", OVERWRITTEN),
    same(
        "params/mod.rs:coordinate_bound:constant:1 -> 2",
        "counts with re-normalisation only, and then no format depends on the range of the input",
    ),
    same(
        "params/formats.rs:row:constant:1 -> 2",
        "every quantity of the table reaches 1, so no format has one integral digit",
    ),
    same("params/formats.rs:row:comparison:> -> >=", "no bound is the greatest number of a format"),
    same("params/formats.rs:Formats:constant:0 -> 1", "takes another name for a row, and names are for messages"),
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
