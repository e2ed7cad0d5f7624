//! Tests of the words that an engine answers.

use super::*;

#[test]
fn answers_and_reports_are_taken_apart_again() {
    let answer = EngineAnswer { verdict: 2, triangles: [(1 << 28) - 1, 77] };
    assert_eq!(EngineAnswer::of(answer.word()), Some(answer));
    assert_eq!(EngineAnswer::of(answer.word() | 4), None);
    let report = EngineReport {
        reason: Reason::BadTree,
        number: 0xabcdef,
        clocks: 1,
        expansions: 2,
        tests: 3,
        survivors: 4,
        leaf_pairs: 5,
        intersect: 6,
        possibly_incorrect: 7,
        blocks: [8, 9],
        triangles: [10, 11],
        words: 12,
        memory_waits: 13,
        queue_waits: 14,
        stack: 15,
    };
    let words = report.words();
    assert_eq!((words[0], words[7]), (0x1_abcd_ef8f, 14 | 15 << 32));
    assert_eq!((EngineReport::of(&words), EngineAnswer::of(words[0])), (Some(report), None));
    assert_eq!(EngineReport::of(&words.map(|word| word & !(1 << 7))), None);
    for (code, reason) in Reason::ALL.into_iter().enumerate() {
        assert_eq!(reason as usize, code);
    }
}
