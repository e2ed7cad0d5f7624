//! The host side of a design in C and Python, and its constants in VHDL.

use crate::artefact::{Prefix, origin};
use crate::design::Design;
use crate::params::options::Choice;
use crate::params::{Params, Quantity, Transform, Upper};
use crate::words::StreamFormat;
use crate::words::constants::{Group, Refusal, groups, ranges};
use askama::Template;
use std::ops::Deref;

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

/// What the files of every host side are made of.
pub struct HostSide<'a> {
    /// The line on top.
    pub header: Vec<String>,
    /// The prefix of all names.
    pub prefix: &'a Prefix,
    /// The entity behind the words, and what stands before the names of constants.
    pub base: &'static str,
    /// That in upper case.
    pub upper: String,
    /// The constants.
    pub groups: Vec<Group>,
    /// What functions refuse.
    pub refusals: Vec<Refusal>,
    /// The first refusal that is about unsigned numbers.
    pub unsigned: &'static str,
    /// The first one that expects nothing in particular.
    pub unexpected: &'static str,
}

impl<'a> HostSide<'a> {
    /// The host side of an entity: its constants, to which those of the ranges of its unit are added, and its refusals, of which the
    /// first that is about unsigned numbers and the first that expects nothing in particular are named.
    pub fn new<const N: usize>(
        named: (&'static str, &'a Prefix),
        (mut groups, unit): (Vec<Group>, &Params),
        list: [(&'static str, &'static str); N],
        firsts: [&'static str; 2],
    ) -> Self {
        groups.insert(1, ranges(unit));
        Self::of(named, groups, list, firsts)
    }

    fn of<const N: usize>(
        (base, prefix): (&'static str, &'a Prefix),
        groups: Vec<Group>,
        list: [(&'static str, &'static str); N],
        [unsigned, unexpected]: [&'static str; 2],
    ) -> Self {
        let refusals = list.map(|(name, what)| Refusal { name, what }).into();
        Self {
            header: origin(),
            prefix,
            base,
            upper: prefix.of(base).to_uppercase(),
            groups,
            refusals,
            unsigned,
            unexpected,
        }
    }
}

/// The retest in C.
#[derive(Template)]
#[template(path = "host/efsat_retest.h", escape = "none")]
struct Retest<'a> {
    h: &'a HostSide<'a>,
}

/// Name of the retest in C, without a prefix.
pub const RETEST: &str = "efsat_retest";

/// The retest in C: name and text.
pub fn retest(prefix: &Prefix) -> (String, String) {
    let refusals = [("NOT_FINITE", "not finite, here as bits: number"), ("WORDS", "more words are needed than")];
    let side = HostSide::of((RETEST, prefix), vec![], refusals, ["NOT_FINITE"; 2]);
    (format!("host/{}.h", prefix.of(RETEST)), Retest { h: &side }.render().expect("the template renders"))
}

/// What the files of the host side of the unit are made of.
struct Host<'a> {
    side: HostSide<'a>,
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

impl<'a> Deref for Host<'a> {
    type Target = HostSide<'a>;

    fn deref(&self) -> &HostSide<'a> {
        &self.side
    }
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
pub(crate) fn files(design: &Design, format: &StreamFormat, prefix: &Prefix) -> [(String, String); 3] {
    let p = &design.params;
    let refusals = [
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
    ];
    let host = Host {
        side: HostSide::new(("efsat", prefix), (groups(design, format), p), refusals, ["TAG", "REPORT"]),
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
    let [c, python] =
        texts.map(|(name, text)| (format!("host/{}", prefix.of(name)), text.expect("the template renders")));
    [c, python, retest(prefix)]
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
