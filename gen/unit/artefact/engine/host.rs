//! The host side of an engine with its trees in block RAM, in Python.

use super::{EngineDesign, NAME};
use crate::artefact::{Prefix, origin};
use crate::golden::Verdict;
use crate::host::engine::TRIANGLES_AT;
use crate::params::engine::{Command, EngineReport, Reason};
use crate::params::stream::REPORT;
use askama::Template;

#[derive(Template)]
#[template(path = "host/efsat_engine.py", escape = "none")]
struct Module<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    query_header: String,
    query_words: u32,
    load_header: String,
    stop_header: String,
    block_lines: u32,
    triangle_lines: u32,
    triangles_at: String,
    verdict_separate: u8,
    verdict_intersect: u8,
    verdict_possibly_incorrect: u8,
    verdict_report: u8,
    report_words: usize,
    reasons: Vec<&'static str>,
}

/// What a reason is called.
fn name(reason: Reason) -> &'static str {
    match reason {
        Reason::Complete => "complete",
        Reason::Contact => "stopped at a certain contact",
        Reason::Limit => "limit of expansions",
        Reason::BadTree => "bad tree",
        Reason::Memory => "memory error",
        Reason::Stopped => "stopped by the host",
        Reason::UnknownHeader => "unknown header",
        Reason::TooShort => "packet too short",
        Reason::TooLong => "packet too long",
    }
}

/// Its name and its text.
pub(super) fn host(design: &EngineDesign, prefix: &Prefix) -> (String, String) {
    let format = &design.format;
    let header = |command| format!("{:08x}", format.header(command) as u32);
    let module = Module {
        header: origin(),
        prefix,
        query_header: header(Command::Query),
        query_words: format.query_words(),
        load_header: header(Command::Load),
        stop_header: header(Command::Stop),
        block_lines: design.params.block_lines,
        triangle_lines: design.params.triangle_lines,
        triangles_at: format!("{:08x}", TRIANGLES_AT << 6),
        verdict_separate: Verdict::Separate as u8,
        verdict_intersect: Verdict::Intersect as u8,
        verdict_possibly_incorrect: Verdict::PossiblyIncorrect as u8,
        verdict_report: REPORT,
        report_words: EngineReport::WORDS,
        reasons: Reason::ALL.map(name).to_vec(),
    };
    (format!("host/{}.py", prefix.of(NAME)), module.render().expect("the template renders"))
}
