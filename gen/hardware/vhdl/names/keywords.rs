//! Reserved words by language, from the standards: IEEE 1076 (VHDL), 1076.1 (VHDL-AMS), 1364 (Verilog), 1800 (SystemVerilog).

/// What is wrong with a word, and the words that a language adds to those above it.
pub(super) const LANGUAGES: [(&str, &str); 8] = [
    (
        "is a keyword of VHDL-87",
        "abs access after alias all and architecture array assert attribute begin block body buffer bus case component \
         configuration constant disconnect downto else elsif end entity exit file for function generate generic guarded \
         if in inout is label library linkage loop map mod nand new next nor not null of on open or others out package \
         port procedure process range record register rem report return select severity signal subtype then to \
         transport type units until use variable wait when while with xor",
    ),
    (
        "is a keyword of VHDL-93",
        "group impure inertial literal postponed pure reject rol ror shared sla sll sra srl unaffected xnor",
    ),
    // VHDL-2002 adds none.
    ("is a keyword of VHDL-2000", "protected"),
    (
        "is a keyword of VHDL-2008",
        "assume assume_guarantee context cover default fairness force parameter property release restrict \
         restrict_guarantee sequence strong vmode vprop vunit",
    ),
    ("is a keyword of VHDL-2019", "private view vpkg"),
    (
        "is a keyword of Verilog-2005",
        "always assign automatic buf bufif0 bufif1 casex casez cell cmos config deassign defparam design disable edge endcase \
         endconfig endfunction endgenerate endmodule endprimitive endspecify endtable endtask event forever fork genvar \
         highz0 highz1 ifnone incdir include initial input instance integer join large liblist localparam macromodule \
         medium module negedge nmos noshowcancelled notif0 notif1 output pmos posedge primitive pull0 pull1 pulldown \
         pullup pulsestyle_ondetect pulsestyle_onevent rcmos real realtime reg repeat rnmos rpmos rtran rtranif0 \
         rtranif1 scalared showcancelled signed small specify specparam strong0 strong1 supply0 supply1 table task time \
         tran tranif0 tranif1 tri tri0 tri1 triand trior trireg unsigned uwire vectored wand weak0 weak1 wire wor",
    ),
    (
        "is a keyword of SystemVerilog",
        "accept_on always_comb always_ff always_latch before bind bins binsof bit break byte chandle checker class clocking \
         const constraint continue covergroup coverpoint cross dist do endchecker endclass endclocking endgroup endinterface \
         endpackage endprogram endproperty endsequence enum eventually expect export extends extern final first_match foreach \
         forkjoin global iff ignore_bins illegal_bins implements implies import inside int interconnect interface \
         intersect join_any join_none let local logic longint matches modport nettype nexttime packed priority program \
         rand randc randcase randsequence ref reject_on s_always s_eventually s_nexttime s_until s_until_with shortint \
         shortreal soft solve static string struct super sync_accept_on sync_reject_on tagged this throughout timeprecision \
         timeunit typedef union unique unique0 until_with untyped var virtual void wait_order weak wildcard within",
    ),
    // Break is one of SystemVerilog, too.
    (
        "is a keyword of VHDL-AMS",
        "across limit nature noise procedural quantity reference spectrum subnature terminal through tolerance",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The standards' own counts of reserved words: 81 in VHDL-87, 97 in 93, 98 in 2000, 115 in 2008.
    #[test]
    fn the_lists_are_complete_and_disjoint() {
        let words = |i: usize| LANGUAGES[i].1.split_ascii_whitespace();
        let mut sum = 0;
        let counts = [81, 97, 98, 115];
        for (i, count) in counts.into_iter().enumerate() {
            sum += words(i).count();
            assert_eq!(sum, count, "{}", LANGUAGES[i].0);
        }
        let all: Vec<&str> = (0..LANGUAGES.len()).flat_map(words).collect();
        assert!(all.iter().all(|word| word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')));
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len(), "a word stands twice");
        // Verilog-2005 has 124 words and SystemVerilog-2017 has 248, some of which are keywords above.
        let verilog = "and begin case default else end for force function generate if inout library nand nor not \
            or parameter release use wait while xnor xor";
        assert_eq!(words(5).count() + verilog.split_ascii_whitespace().count(), 124);
        let system = "alias assert assume context cover new null package property protected pure \
            restrict return sequence strong type until with";
        assert_eq!(words(6).count() + system.split_ascii_whitespace().count() + 124, 248);
        let above: BTreeSet<&str> = all.into_iter().collect();
        assert!(verilog.split_ascii_whitespace().chain(system.split_ascii_whitespace()).all(|w| above.contains(w)));
    }
}
