//! The proofs in `proofs/`: Coq's kernel checks them, nothing is assumed beside the axioms of the standard library's real
//! numbers, and the functions that are proved answer as the reference models do, number for number (docs/trust.md).
//!
//! Without Coq the tests say so on standard error and prove nothing. On every change the kernel checks a part of the files and
//! compares some cases; if everything is asked for, all files and the assumptions of all main theorems.

mod vectors;

use crate::extent::{full, share};
use crate::recorded::{Outcome, Question};
use crate::tools::{has, program, replaced};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use vectors::Vectors;

/// What the theorems about real numbers may rest on.
const ALLOWED: [&str; 2] =
    ["ClassicalDedekindReals.sig_forall_dec", "FunctionalExtensionality.functional_extensionality_dep"];

/// Words of a proof that is none.
const FORBIDDEN: [&str; 12] = [
    "Admitted",
    "admit",
    "give_up",
    "Axiom",
    "Axioms",
    "Parameter",
    "Parameters",
    "Conjecture",
    "Abort",
    "Unset",
    "bypass_check",
    "type_in_type",
];

/// The files of the book.
fn chapters() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir("proofs").unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "v"));
    files.sort();
    files
}

/// A text without comments, and without what an instance has to prove.
fn code(text: &str) -> String {
    let mut code = String::new();
    let (mut depth, mut rest) = (0, text);
    while let Some(c) = rest.chars().next() {
        let step = match (&rest[..rest.len().min(2)], depth) {
            ("(*", _) => {
                depth += 1;
                2
            }
            ("*)", 1..) => {
                depth -= 1;
                2
            }
            (_, 0) => {
                code.push(c);
                c.len_utf8()
            }
            _ => c.len_utf8(),
        };
        rest = &rest[step..];
    }
    match (code.split_once("Module Type"), code.split_once("End DOM.")) {
        (Some((before, _)), Some((_, after))) => format!("{before}{after}"),
        _ => code,
    }
}

/// Words of a text that make a proof none.
fn forbidden(text: &str) -> Vec<&'static str> {
    let code = code(text);
    let words: BTreeSet<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    FORBIDDEN.into_iter().filter(|word| words.contains(word)).collect()
}

#[test]
fn no_proof_is_left_out() {
    let files = chapters();
    assert!(files.len() > 15);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.starts_with("(** "), "{} begins with what it proves", path.display());
        assert_eq!(forbidden(&text), [""; 0], "{}", path.display());
    }
    let mutants = [
        ("Lemma l : False. Admitted.", "Admitted"),
        ("Proof. admit. Qed.", "admit"),
        ("Parameter x : nat.", "Parameter"),
        ("Module Type DOM.\nParameter C : Type.\nEnd DOM.\nAxiom a : False.", "Axiom"),
        ("(* a *) Unset Guard Checking.", "Unset"),
    ];
    for (text, word) in mutants {
        assert_eq!(forbidden(text), [word]);
    }
    assert_eq!(
        forbidden("Module Type DOM.\nAxiom a : True.\nEnd DOM.\n(* Admitted (* admit *) *) Lemma admitted : True."),
        [""; 0]
    );
}

/// Brings a folder below `target/` up to date with the book, each file by its name as `change` has it. Files that do not change are
/// not checked again.
fn copy(to: &Path, change: impl Fn(&str, String) -> String) {
    fs::create_dir_all(to).unwrap();
    let names: BTreeSet<_> = chapters().iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    for entry in fs::read_dir(to).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "v") && !names.contains(path.file_name().unwrap()) {
            fs::remove_file(path).unwrap();
        }
    }
    for path in chapters() {
        let text = change(path.file_stem().unwrap().to_str().unwrap(), fs::read_to_string(&path).unwrap());
        let to = to.join(path.file_name().unwrap());
        if fs::read_to_string(&to).is_ok_and(|old| old == text) {
            continue;
        }
        fs::write(to, text).unwrap();
    }
}

/// A text without its proofs: what is defined and what is stated.
fn stated(text: &str) -> String {
    let mut parts = text.split("Proof.");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |all, part| all + "Admitted." + part.split_once("Qed.").map_or("", |(_, rest)| rest))
}

/// Makes files of a folder: `X.vo` is a file that is checked with all that it needs.
fn make(dir: &Path, targets: &[&str]) -> Result<(), String> {
    let names = || chapters().into_iter().map(|path| path.file_name().unwrap().to_owned());
    let run = |command: &mut Command| match program::ran(command.current_dir(dir)) {
        (Some(0), ..) => Ok(()),
        (_, output, errors) => Err(output + &errors),
    };
    run(Command::new("coq_makefile").args(["-R", ".", "Efsat", "-o", "Makefile"]).args(names()))?;
    run(Command::new("make").args(["-s", if full() { "-j2" } else { "-j1" }]).args(targets))
}

/// Whether Coq is there.
fn there() -> bool {
    has("Coq", "coqc", "--version")
}

/// What the printed assumptions name that is not allowed.
fn assumed(printed: &str) -> Vec<&str> {
    // A type that is long begins in the next line.
    let names = printed.lines().filter(|line| !line.starts_with(' ') && !line.is_empty() && *line != "Axioms:");
    names.map(|line| line.split(" :").next().unwrap_or(line)).filter(|name| !ALLOWED.contains(name)).collect()
}

#[test]
fn the_kernel_checks_the_proofs() {
    if !there() {
        return;
    }
    let dir = Path::new("target/proofs/book");
    copy(dir, |_, text| text);
    if !full() {
        const PART: [&str; 5] = ["Interval.vo", "Determinants.vo", "Hierarchy.vo", "Stack.vo", "Certificate.vo"];
        Question::of(&[], &[&book(dir), &PART.concat()]).answer(|| {
            make(dir, &PART).unwrap_or_else(|e| panic!("{e}"));
            Outcome::Proved
        });
        return;
    }
    make(dir, &["all"]).unwrap_or_else(|e| panic!("{e}"));
    let (status, printed, errors) =
        program::ran(Command::new("coqc").args(["-R", ".", "Efsat", "Main.v"]).current_dir(dir));
    assert_eq!(status, Some(0), "{errors}");
    println!("{printed}");
    let reals = printed.strip_prefix("Closed under the global context\n").expect("integers need no axiom");
    assert!(reals.starts_with("Axioms:\n"));
    assert_eq!(assumed(reals), [""; 0]);
    let cheat = "Axioms:\nOnIntegers.cheat : False\nClassicalDedekindReals.sig_forall_dec :\n  forall P\n";
    assert_eq!(assumed(cheat), ["OnIntegers.cheat"]);
}

/// What the kernel says of a text that needs a file of a folder, if it does not accept it.
fn accepted(dir: &Path, file: &str, text: &str) -> Result<(), String> {
    make(dir, &[file]).unwrap_or_else(|e| panic!("{e}"));
    fs::write(dir.join("Words.v"), text).unwrap();
    match program::ran(Command::new("coqc").args(["-R", ".", "Efsat", "Words.v"]).current_dir(dir)) {
        (Some(0), ..) => Ok(()),
        (_, output, errors) => Err(output + &errors),
    }
}

/// Whether the kernel accepts each of some certificates, as theorems; none if Coq is not there.
pub fn certified(theorems: &[String]) -> Option<Vec<bool>> {
    let dir = Path::new("target/proofs/certificates");
    there().then(|| {
        copy(dir, |_, text| text);
        theorems.iter().map(|text| accepted(dir, "Certificate.vo", text).is_ok()).collect()
    })
}

/// The files of a folder.
fn book(dir: &Path) -> String {
    chapters().iter().map(|path| fs::read_to_string(dir.join(path.file_name().unwrap())).unwrap()).collect()
}

/// Runs the functions of a folder on vectors; refuted if they differ.
fn compared(dir: &Path, vectors: &Vectors) -> Outcome {
    let text = vectors.text();
    Question::of(&[], &[&book(dir), &text]).answer(|| match accepted(dir, "Compare.vo", &text) {
        Ok(()) => Outcome::Proved,
        Err(said) if different(&said) => Outcome::Refuted(said),
        Err(said) => panic!("{said}"),
    })
}

/// Whether the kernel says that there are differences, and nothing else is wrong.
fn different(said: &str) -> bool {
    said.split_whitespace().collect::<Vec<_>>().join(" ").contains("Unable to unify \"[]\" with \"[(")
}

/// Mistakes in the functions that are proved: file, text, and what stands there instead.
const MUTANTS: [[&str; 3]; 5] = [
    ["CrossTable", "(apart P N || apart N P)", "(apart P N && apart N P)"],
    ["Determinants", "Definition F level x := 4 * x", "Definition F level x := 3 * x"],
    ["DeterminantUnit", "Z.max (fine o - d) 0", "Z.max (fine o - d - 1) 0"],
    ["AxisUnit", "(least hi a <? most lo b)", "(least hi a <=? most lo b)"],
    ["Table", "negb (seq p O && seq q O)", "negb (seq p O || seq q O)"],
];

#[test]
fn the_functions_that_are_proved_answer_as_the_reference_models_do() {
    if !there() {
        return;
    }
    let dir = Path::new("target/proofs/functions");
    copy(dir, |_, text| stated(&text));
    let vectors = Vectors::new(if full() { 100 } else { 6 });
    let outcome = compared(dir, &vectors);
    assert!(matches!(outcome, Outcome::Proved), "{outcome:?}");
    println!("{vectors}");
    // One number of one case changed is noticed, of every method.
    let few = Vectors::new(1);
    for method in share(Vectors::METHODS, 0..Vectors::METHODS) {
        assert!(matches!(compared(dir, &few.changed(method)), Outcome::Refuted(_)), "a changed number is noticed");
    }
    // So is a mistake in a function.
    let some = Vectors::new(if full() { 30 } else { 1 });
    for [file, text, other] in MUTANTS.iter().filter(|_| full()) {
        let home = tempfile::tempdir().unwrap();
        copy(home.path(), |name, book| stated(&if name == *file { replaced(&book, text, other) } else { book }));
        assert!(matches!(compared(home.path(), &some), Outcome::Refuted(_)), "{other}");
    }
}
