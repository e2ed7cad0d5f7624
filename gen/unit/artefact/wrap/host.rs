//! The host side of a design in C and Python, and its constants in VHDL.

use crate::artefact::{Prefix, origin};
use crate::design::Design;
use crate::params::options::Choice;
use crate::params::{Quantity, Transform, Upper};
use crate::words::StreamFormat;
use crate::words::constants::{Group, Refusal, groups, ranges, refusals};
use askama::Template;

#[derive(Template)]
#[template(path = "efsat_constants.vhd", escape = "none")]
struct Package<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    /// What the constants are of, whose name begins that of the package, and for whom they are.
    of: &'a str,
    whose: &'a str,
    groups: Vec<Group>,
}

/// What the files of the host side are made of.
struct Host<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    /// The entity behind the words, and what stands before the names of constants.
    base: &'static str,
    upper: String,
    groups: Vec<Group>,
    refusals: Vec<Refusal>,
    /// The first refusals that are about unsigned numbers, and that expect nothing in particular.
    unsigned: &'static str,
    unexpected: &'static str,
    has_tag: bool,
    is_sticky: bool,
    has_pose: bool,
    has_matrix: bool,
    has_outside: bool,
    /// Whether a guard takes numbers outside their ranges, and which functions there are for it.
    has_guards: bool,
    variants: &'static [bool],
    method: &'static str,
    edge_test: bool,
}

/// The file in C.
#[derive(Template)]
#[template(path = "host/efsat.h", escape = "none")]
struct Header<'a> {
    h: &'a Host<'a>,
}

/// The file in Python.
#[derive(Template)]
#[template(path = "host/efsat.py", escape = "none")]
struct Module<'a> {
    h: &'a Host<'a>,
}

/// The host side in C and in Python: names and texts.
pub(crate) fn files(design: &Design, format: &StreamFormat, prefix: &Prefix) -> [(String, String); 2] {
    let p = &design.params;
    let mut groups = groups(design, format);
    groups.insert(1, ranges(p));
    let host = Host {
        header: origin(),
        prefix,
        base: "efsat",
        upper: prefix.of("efsat").to_uppercase(),
        groups,
        refusals: refusals([
            ("COORDINATE", Quantity::Coordinate.name()),
            ("ENTRY", Quantity::Entry.name()),
            ("TRANSLATION", Quantity::Translation.name()),
            ("NUMBER", Quantity::Unread.name()),
            ("STICKY", "sticky bits"),
            ("TAG", "tag"),
            ("ORDER", "tag of answer"),
            ("SIZE", "bytes of the answer"),
            ("REPORT", "a report in place of a verdict, answer"),
            ("ANSWER", "a word that no unit of this design sends, answer"),
        ]),
        unsigned: "TAG",
        unexpected: "REPORT",
        has_tag: p.tag_width > 0,
        is_sticky: p.upper == Upper::Sticky,
        has_pose: format.has_pose(),
        has_matrix: p.transform == Transform::On,
        has_outside: p.guarded(),
        has_guards: p.has_guards(),
        variants: if p.has_guards() { &[false, true] } else { &[false] },
        method: p.method.name(),
        edge_test: p.edge_test,
    };
    let texts = [("efsat.h", Header { h: &host }.render()), ("efsat.py", Module { h: &host }.render())];
    texts.map(|(name, text)| (format!("host/{}", prefix.of(name)), text.expect("the template renders")))
}

/// The package of constants in VHDL.
pub(crate) fn package(design: &Design, format: &StreamFormat, prefix: &Prefix) -> String {
    let whose = format!("{prefix}efsat or {prefix}efsat_stream. The unit");
    constants_package(groups(design, format), prefix, "efsat", &whose)
}

/// The package of constants of an entity; `whose` says for whom they are, and who does not use them.
pub fn constants_package(groups: Vec<Group>, prefix: &Prefix, of: &str, whose: &str) -> String {
    let package = Package { header: origin(), prefix, of, whose, groups };
    package.render().expect("the template renders")
}
