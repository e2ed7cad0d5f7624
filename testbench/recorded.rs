//! What was proved before. An answer of a prover depends on what it is asked alone, so the tests do not ask again what is in
//! `testbench/proofs.txt`: there `scripts/prove` writes what it has asked, with the answer. One question of sixteen is asked all the
//! same, and all are if everything is asked for: another answer than the recorded one is a failure.

use crate::extent::full;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::LazyLock;

/// What a prover says of a claim.
#[derive(Debug)]
pub enum Outcome {
    /// There is no counterexample.
    Proved,
    /// There is one: the inputs, as Yosys prints them; or what Coq's kernel says.
    Refuted(String),
    /// Neither, in the time allowed.
    Undecided,
}

/// A question to a prover: the hash of all that it depends on.
pub struct Question(String);

const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/testbench/proofs.txt");

/// Where answers are written to, as `scripts/prove` asks; then all questions are asked.
const WRITTEN: &str = "EFSAT_PROOFS";

/// The answers by question: whether it is proved.
static BEFORE: LazyLock<BTreeMap<String, bool>> = LazyLock::new(|| read(&std::fs::read_to_string(RECORD).unwrap()));

fn read(text: &str) -> BTreeMap<String, bool> {
    let answers = text.lines().map(|line| match line.split_once(' ') {
        Some((hash, "proved")) => (hash.to_owned(), true),
        Some((hash, "refuted")) => (hash.to_owned(), false),
        _ => panic!("testbench/proofs.txt: {line}: expected a hash, and proved or refuted"),
    });
    answers.collect()
}

/// A line of VHDL without its comment; a line whose comment may be in a string is left as it is.
fn code(line: &str) -> &str {
    line.split_once("--").map(|(code, _)| code).filter(|code| !code.contains('"')).unwrap_or(line)
}

impl Question {
    /// Of VHDL, the comments of which do not matter, and of other text.
    pub fn of(vhdl: &[(String, String)], others: &[&str]) -> Self {
        let mut hash = Sha256::new();
        for line in vhdl.iter().flat_map(|(_, text)| text.lines()) {
            hash.update(code(line).trim_end());
            hash.update("\n");
        }
        for text in others {
            hash.update("\0");
            hash.update(text);
        }
        Self(hash.finalize()[..12].iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// Its recorded answer, or the one that is given now.
    pub fn answer(&self, ask: impl FnOnce() -> Outcome) -> Outcome {
        self.before().unwrap_or_else(|| {
            let outcome = ask();
            self.keep(&outcome);
            outcome
        })
    }

    /// Its recorded answer, unless it is to be asked all the same.
    fn before(&self) -> Option<Outcome> {
        let again = full() || std::env::var_os(WRITTEN).is_some() || self.0.starts_with('f');
        let proved = BEFORE.get(&self.0).filter(|_| !again)?;
        Some(if *proved { Outcome::Proved } else { Outcome::Refuted("as before".to_owned()) })
    }

    /// Compares an answer with the record, or writes it.
    fn keep(&self, outcome: &Outcome) {
        let proved = match outcome {
            Outcome::Proved => true,
            Outcome::Refuted(_) => false,
            Outcome::Undecided => return,
        };
        if let Some(path) = std::env::var_os(WRITTEN) {
            let mut file = std::fs::OpenOptions::new().create(true).append(true).open(path).unwrap();
            // One write, so that lines of several threads do not mix.
            file.write_all(format!("{} {}\n", self.0, if proved { "proved" } else { "refuted" }).as_bytes()).unwrap();
        } else {
            self.compare(proved);
        }
    }

    fn compare(&self, proved: bool) {
        if let Some(before) = BEFORE.get(&self.0) {
            assert_eq!(proved, *before, "{}: another answer than in testbench/proofs.txt", self.0);
        }
    }
}

#[test]
fn a_question_is_known_by_all_but_the_comments_of_vhdl() {
    let question = |vhdl: &str, claim: &str| Question::of(&[("a.vhd".to_owned(), vhdl.to_owned())], &[claim]).0;
    let known = question("x <= a and b;  -- both\n", "assert(x);");
    assert_eq!(known, question("x <= a and b;\n", "assert(x);"));
    for (vhdl, claim) in [("x <= a or b;\n", "assert(x);"), ("x <= a and b;\n", "assert(!x);"), ("", "x <= a and b;\n")]
    {
        assert_ne!(known, question(vhdl, claim));
    }
    // What stands in a string is no comment.
    assert_ne!(question("x <= \"--01\";\n", ""), question("x <= \"--10\";\n", ""));
    assert_eq!(read("0a proved\n1b refuted\n"), [("0a".to_owned(), true), ("1b".to_owned(), false)].into());
    assert!(BEFORE.values().any(|proved| *proved) && BEFORE.values().any(|proved| !*proved));
}

/// An answer that is not the recorded one is a failure.
#[test]
#[should_panic(expected = "another answer than in testbench/proofs.txt")]
fn another_answer_is_noticed() {
    let (hash, proved) = BEFORE.iter().next().unwrap();
    Question(hash.clone()).compare(!proved);
}
