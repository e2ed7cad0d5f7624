//! The commands that pages print, in code blocks, in tables and in sentences: `efsat` takes each of them, with its options and
//! values; each `cargo test` names a package, features and a filter that there are, and each `scripts/...` is there and knows its
//! arguments. Nothing that takes long is run. Paths of the repository that pages name exist.

mod cargo;
mod shell;

use crate::book::{pages, prose, root, text};
use crate::tools::program::{refuses, succeeds};
use clap::error::ErrorKind;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt;

/// What stands for a word such as FILE or N. All of them in a command stand for the same, so one that fits all must be there.
const STAND_INS: [&str; 6] = ["18", "11", "headlight", "xc2v6000-4", "guigue-devillers", "generate"];

/// Options that pages name and that are of other programs: FuseSoC, cargo.
const OTHERS: [&str; 2] = ["--cores-root", "--release"];

/// Folders whose paths pages name.
const FOLDERS: [&str; 11] =
    ["benches", "docs", "examples", "gen", "rtl-out", "scenes", "scripts", "templates", "testbench", "web", "workflow"];

/// Paths that pages name and that are not there: what a reader makes.
const TO_BE_MADE: [&str; 1] = ["gen/hardware/op/minimum.rs"];

/// A piece of code on a page.
#[derive(Debug, PartialEq)]
enum Code {
    /// A block, whose commands are meant to be typed.
    Block(String),
    /// Within a sentence or a table, where what a command needs may be left out.
    Span(String),
}

/// All code of a page; blocks of other languages are left out.
fn code(page: &str) -> Vec<Code> {
    let mut found = vec![];
    let mut block: Option<(bool, String)> = None;
    for line in page.lines() {
        match (line.trim_start().strip_prefix("```"), block.take()) {
            (Some(language), None) => block = Some((language == "sh", String::new())),
            (Some(_), Some((shell, text))) => found.extend(shell.then_some(Code::Block(text))),
            (None, Some((shell, text))) => block = Some((shell, text + line.trim_start() + "\n")),
            (None, None) => {}
        }
    }
    let prose = prose(page).join("\n");
    for paragraph in prose.split("\n\n") {
        if paragraph.lines().all(|line| line.starts_with("    ")) {
            found.push(Code::Block(paragraph.lines().map(|line| line.trim_start().to_owned() + "\n").collect()));
            continue;
        }
        let spans = paragraph.split('`').skip(1).step_by(2);
        found.extend(spans.map(|span| Code::Span(span.split_whitespace().collect::<Vec<_>>().join(" "))));
    }
    found
}

/// Whether a word stands for another one: N, FILE, ...
fn is_placeholder(word: &str) -> bool {
    let word = word.trim_end_matches("::");
    word == "..." || (!word.is_empty() && word.chars().all(|c| c.is_ascii_uppercase()))
}

/// The words with all placeholders replaced, by each of the stand-ins; OPTIONS are none.
fn filled(words: &[String]) -> Vec<Vec<String>> {
    let words: Vec<&String> = words.iter().filter(|word| *word != "OPTIONS").collect();
    let with = |stand_in: &str| {
        let fill = |word: &&String| if is_placeholder(word) { stand_in.to_owned() } else { (*word).clone() };
        words.iter().map(fill).collect::<Vec<_>>()
    };
    let any = words.iter().any(|word| is_placeholder(word));
    STAND_INS[..if any { STAND_INS.len() } else { 1 }].iter().map(|stand_in| with(stand_in)).collect()
}

/// The words with `a|b` as a, and as b.
fn alternatives(words: &[String]) -> Vec<Vec<String>> {
    let most = words.iter().map(|word| word.split('|').count()).max().unwrap_or(1);
    let take =
        |n: usize| words.iter().map(move |word| word.split('|').cycle().nth(n).unwrap_or(word).to_owned()).collect();
    (0..most).map(take).collect()
}

/// What the command line has against these words; `whole` if nothing may be left out.
fn refused(words: &[String], whole: bool) -> Option<clap::Error> {
    let error = efsat_cli::check(words.iter().map(String::as_str)).err()?;
    let left_out = [
        ErrorKind::MissingRequiredArgument,
        ErrorKind::MissingSubcommand,
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand,
    ];
    let value_left_out = error.to_string().contains("a value is required");
    let fine = !error.use_stderr() || (!whole && (value_left_out || left_out.contains(&error.kind())));
    (!fine).then_some(error)
}

/// What is wrong with a command of `efsat`, by the words after its name.
fn efsat(words: &[String], whole: bool) -> Option<String> {
    let refused = |words: &[String]| -> Option<clap::Error> {
        let mut tried = filled(words).into_iter().map(|words| refused(&words, whole));
        let first = tried.next().expect("one at least")?;
        tried.all(|error| error.is_some()).then_some(first)
    };
    refused(words)?;
    let error = alternatives(words).iter().find_map(|words| refused(words))?;
    Some(error.to_string().lines().next().unwrap_or_default().to_owned())
}

/// Every command with the words that call it.
fn leaves(command: &clap::Command, before: &[String], found: &mut Vec<(Vec<String>, clap::Command)>) {
    for inner in command.get_subcommands() {
        let words: Vec<String> = before.iter().cloned().chain([inner.get_name().to_owned()]).collect();
        leaves(inner, &words, found);
        found.push((words, inner.clone()));
    }
}

/// What is wrong with options that stand without their command: they are of no command, or no command takes their values. Values
/// that stand for others are not tried.
fn options(words: &[String]) -> Option<String> {
    let mut commands = vec![];
    leaves(&efsat_cli::command(), &[], &mut commands);
    let has = |command: &clap::Command, word: &str| {
        let name = word.trim_start_matches('-').split('=').next();
        command.get_arguments().any(|argument| argument.get_long() == name) || name == Some("help")
    };
    let names = words.iter().filter(|word| word.starts_with("--"));
    let known =
        |word: &&String| OTHERS.contains(&word.as_str()) || commands.iter().any(|(_, command)| has(command, word));
    if let Some(name) = names.clone().find(|word| !known(word)) {
        return Some(format!("{name}: no option of any command"));
    }
    let stands_for = |word: &String| {
        !word.starts_with("--") && (word.contains("..") || word.chars().any(|c| c.is_ascii_uppercase()))
    };
    let takes = |(before, _): &(Vec<String>, clap::Command)| efsat(&[before, words].concat(), false).is_none();
    let tried = names.clone().all(|word| !OTHERS.contains(&word.as_str())) && !words.iter().any(stands_for);
    (tried && !commands.iter().any(takes)).then(|| "no command takes these values".to_owned())
}

/// Whether a word stands by itself in the commands of a script.
fn knows(script: &str, word: &str) -> bool {
    let inner = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let commands = script.lines().filter(|line| !line.trim_start().starts_with('#'));
    commands.flat_map(|line| line.split(|c| !inner(c))).any(|found| found == word)
}

/// What is wrong with a script and its arguments.
fn script(path: &str, arguments: &[String], whole: bool) -> Option<String> {
    let file = root().join(path);
    let Ok(about) = fs::metadata(&file) else { return Some(format!("{path}: no such script")) };
    if about.is_dir() {
        return None;
    }
    if about.permissions().mode() & 0o111 == 0 {
        return Some(format!("{path}: cannot be run"));
    }
    let arguments: Vec<String> = arguments.iter().map(|word| word.trim_matches(['[', ']']).to_owned()).collect();
    if path == "scripts/overflow" {
        return cargo::fault(&[&["test".to_owned()], &arguments[..]].concat());
    }
    let script = fs::read_to_string(file).unwrap();
    // Options go on to the design, where there is one.
    let design = arguments.iter().position(|word| word.starts_with("--") && script.contains("\"$@\""));
    let (own, design) = arguments.split_at(design.unwrap_or(arguments.len()));
    if let Some(fault) = efsat(&[&["generate".to_owned()], design].concat(), whole) {
        return Some(fault);
    }
    let figures = fs::read_to_string(root().join("docs/figures.toml")).unwrap();
    let known = |word: &&str| {
        is_placeholder(word)
            || knows(&script, word)
            || (path == "scripts/prove"
                && cargo::tests("testbench").iter().any(|test| test.starts_with(&format!("proofs::{word}"))))
            || (path == "scripts/figures" && figures.contains(&format!("\n[{word}]\n")))
    };
    let words = own.iter().flat_map(|word| word.split('|'));
    words.filter(|word| !known(word)).map(|word| format!("{word}: no argument of {path}")).next()
}

/// What is wrong with one command; nothing if it is of another program.
fn command(words: &[String], whole: bool) -> Option<String> {
    let (name, arguments) = words.split_first()?;
    match name.trim_start_matches("./") {
        "efsat" | "target/release/efsat" => efsat(arguments, whole),
        "cargo" => match arguments.iter().position(|word| word == "--") {
            Some(at) if arguments[0] == "run" => efsat(&arguments[at + 1..], whole),
            _ => cargo::fault(arguments),
        },
        path if path.starts_with("scripts/") => script(path, arguments, whole),
        _ => None,
    }
}

/// What is wrong with a word that may be a path of the repository.
fn path(word: &str) -> Option<String> {
    let word = word.trim_matches([',', ';', ':', '(', ')', '"']).trim_start_matches("./");
    let plain = word.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c)) && !word.contains("...");
    let (folder, _) = word.split_once('/')?;
    let ours = plain && FOLDERS.contains(&folder) && !TO_BE_MADE.contains(&word);
    (ours && !root().join(word).exists()).then(|| format!("{word}: no such file"))
}

/// Everything that is wrong with the code of a page.
fn faults(page: &str, text: &str) -> Vec<String> {
    let mut faults = vec![];
    for code in code(text) {
        let (text, whole) = match &code {
            Code::Block(text) => (text.as_str(), true),
            Code::Span(text) => (text.as_str(), false),
        };
        let first = text.split(' ').next().unwrap_or_default();
        // Of a table, whose `|` has a stroke before it, and which are no pipes.
        let span = || text.replace("\\|", "|").replace('|', "\u{1}");
        let commands = match code {
            Code::Block(_) => shell::commands(text),
            Code::Span(_) => shell::commands(&span()),
        };
        let commands =
            commands.into_iter().map(|words| words.into_iter().map(|word| word.replace('\u{1}', "|")).collect());
        for words in commands.collect::<Vec<Vec<String>>>() {
            let mut say = |fault: String| faults.push(format!("{page}: `{}`: {fault}", words.join(" ")));
            let fault = match words.first() {
                // A message, which quotes an option.
                Some(_) if text.contains(": expected ") => None,

                Some(word) if !whole && (word == "-p" || word == "--" || first.ends_with("::")) => {
                    cargo::fault(&[&["test".to_owned()], &words[..]].concat())
                }
                Some(word) if !whole && word.starts_with("--") => options(&words),
                _ => command(&words, whole),
            };
            fault.into_iter().for_each(&mut say);
            words.iter().filter_map(|word| path(word)).for_each(&mut say);
        }
    }
    faults
}

#[test]
fn every_command_is_one() {
    let of_users = pages().into_iter().filter(|page| page != "CHANGELOG.md");
    let faults: Vec<String> = of_users.flat_map(|page| faults(&page, &text(&page))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Options of a command, by their long names; of those that are of a design, or of all others.
fn long_names(command: &clap::Command, of_design: bool) -> Vec<String> {
    let wanted = |argument: &&clap::Arg| argument.is_hide_short_help_set() == of_design;
    command.get_arguments().filter(wanted).filter_map(|argument| Some(format!("--{}", argument.get_long()?))).collect()
}

/// Whether a text has an option, and not only one whose name begins so.
fn names(text: &str, option: &str) -> bool {
    let inner = |c: char| c.is_alphanumeric() || c == '-';
    text.match_indices(option).any(|(at, _)| !text[at + option.len()..].starts_with(inner))
}

/// The page of options has those of designs, some page each other one and every command.
#[test]
fn every_command_and_option_is_on_a_page() {
    let of_users = pages().into_iter().filter(|page| page.starts_with("docs/") || page == "README.md");
    let all: String = of_users.map(|page| text(&page)).collect();
    let options = text("docs/options.md");
    let mut commands = vec![];
    leaves(&efsat_cli::command(), &[], &mut commands);
    let mut absent = vec![];
    for (words, command) in &commands {
        let call = format!("efsat {}", words.join(" "));
        let own = long_names(command, false).into_iter().filter(|option| !names(&all, option));
        let of_design = long_names(command, true).into_iter().filter(|option| !names(&options, option));
        absent.extend(own.chain(of_design).map(|option| format!("{call} {option}")));
        absent.extend((!all.contains(&call)).then_some(call));
    }
    assert!(commands.len() > 20 && absent.is_empty(), "{absent:?}");
    assert!(names("a --width=1", "--width") && !names("--widths --width-2", "--width"));
}

/// The options of a design are one line of short help, and that line prints them.
#[test]
fn short_help_is_short() {
    let mut commands = vec![];
    leaves(&efsat_cli::command(), &[], &mut commands);
    commands.retain(|(_, command)| !long_names(command, true).is_empty());
    for (words, command) in &commands {
        let call = words.join(" ");
        let (short, design) =
            (succeeds(root(), &format!("{call} -h")), succeeds(root(), &format!("{call} --help-design")));
        let listed = |help: &str, option: &String| {
            help.lines().any(|line| names(line.trim_start(), option) && line.trim_start().starts_with(option.as_str()))
        };
        assert!(short.lines().count() < 50, "{call}: {short}");
        let (of_design, own) = (long_names(command, true), long_names(command, false));
        assert!(of_design.iter().all(|option| listed(&design, option) && !listed(&short, option)), "{call}: {design}");
        assert!(own.iter().all(|option| !listed(&design, option) && listed(&short, option)), "{call}: {design}{short}");
    }
    assert!(commands.len() >= 13);
    refuses(root(), "list --help-design", "unexpected argument '--help-design'");
}

/// What pages ask to be compiled compiles: each package alone, with the features that are printed.
#[test]
#[ignore = "compiles packages once more, two minutes"]
fn the_packages_of_printed_tests_compile() {
    let code = pages().into_iter().flat_map(|page| code(&text(&page)));
    let texts = code.map(|code| match code {
        Code::Block(text) | Code::Span(text) => text,
    });
    let commands = texts.flat_map(|text| shell::commands(&text));
    let tests = commands.filter_map(|words| {
        let rest = match words.first()?.as_str() {
            "cargo" if words.get(1)? == "test" => &words[2..],
            "-p" => &words[..],
            _ => return None,
        };
        cargo::selection(rest)
    });
    let named = tests.filter(|selection| !selection.iter().any(|word| is_placeholder(word)));
    let selections: BTreeSet<Vec<String>> = named.collect();
    assert!(selections.len() >= 3, "{selections:?}");
    for selection in selections {
        let mut check = std::process::Command::new(env!("CARGO"));
        check.args(["check", "--release", "--tests", "--offline", "--quiet"]).args(&selection).current_dir(root());
        let output = check.output().unwrap();
        assert!(output.status.success(), "{selection:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

/// The checks complain of each of these, and of nothing else.
#[test]
fn the_checks_can_fail() {
    let page = "A `efsat generate --widht 18`, `efsat synth --width N`, `efsat generate --width 99` and `efsat genrate`.\n\n\
        | `--bound static\\|edges\\|momnets` | `--spam` | `--span 0\\|1\\|3` |\n\n\
        ```sh\n\
        efsat classify                # a file is left out? no: pairs\n\
        printf 'efsat nonsense # '; scripts/nothing && scripts/prove quick produkts | cat > scripts/none.txt\n\
        scripts/prove full products; scripts/board --frequency 100; scripts/board --frequenzy 100; scripts/test all; scripts/figures sweeps\n\
        X=1 cargo test -p efsat-unit --features scnes determinants::\n\
        cargo test -p efsat-unit --features scenes \\\n  nothing_of_this_name\n\
        cargo test --release --test testbnech; cargo test -p efsat-units; cargo test --test testbench books::\n\
        cargo bench -p benches --bench goldn; cargo rum; cargo run --release -- cosim --randon 4; cargo test --test testbench book::\n\
        efsat generate --width; efsat generate --method exact --like-paper\n\
        ```\n\n\
        `book::` `boek::` `-p efsat-hardware opp::` `gen/unit/nothing.rs` `efsat tree build` `efsat classify FILE --k K`\n\n\
        ```text\nefsat nonsense\n```\n";
    let expected = [
        ("scripts/nothing", "scripts/nothing: no such script"),
        ("scripts/nothing", "scripts/nothing: no such file"),
        ("scripts/prove quick produkts", "produkts: no argument of scripts/prove"),
        ("scripts/board --frequenzy 100", "error: unexpected argument '--frequenzy' found"),
        ("scripts/test all", "all: no argument of scripts/test"),
        ("scripts/figures sweeps", "sweeps: no argument of scripts/figures"),
        ("cargo test -p efsat-unit --features scnes determinants::", "scnes: no feature of efsat-unit"),
        (
            "cargo test -p efsat-unit --features scenes nothing_of_this_name",
            "nothing_of_this_name: no test of efsat-unit",
        ),
        ("cargo test --release --test testbnech", "testbnech: no test of efsat"),
        ("cargo test -p efsat-units", "efsat-units: no such package"),
        ("cargo test --test testbench books::", "books::: no test of testbench"),
        ("cargo bench -p benches --bench goldn", "goldn: no bench of benches"),
        ("cargo rum", "cargo rum: no such command"),
        ("cargo run --release -- cosim --randon 4", "error: unexpected argument '--randon' found"),
        ("efsat generate --width", "error: a value is required for '--width <N>' but none was supplied"),
        (
            "efsat generate --method exact --like-paper",
            "error: --like-paper with --method exact: expected --method axes",
        ),
        ("efsat generate --widht 18", "error: unexpected argument '--widht' found"),
        (
            "efsat generate --width 99",
            "error: invalid value '99' for '--width <N>': expected a whole number from 6 to 32",
        ),
        ("efsat genrate", "error: unrecognized subcommand 'genrate'"),
        ("--bound static|edges|momnets", "no command takes these values"),
        ("--spam", "--spam: no option of any command"),
        (
            "boek::",
            "boek::: no test of efsat, efsat-hardware, efsat-geometry, efsat-unit, efsat-engine, efsat-checks, efsat-studies, efsat-cli, benches, testbench",
        ),
        ("-p efsat-hardware opp::", "opp::: no test of efsat-hardware"),
        ("gen/unit/nothing.rs", "gen/unit/nothing.rs: no such file"),
        ("efsat classify FILE --k K", "error: unexpected argument '--k' found"),
    ];
    let expected = expected.map(|(command, fault)| format!("x: `{command}`: {fault}"));
    assert_eq!(faults("x", page), expected);
}
