//! The package of a design: the types of its bundles, and the few functions that its entities share.

use super::shape::Types;
use askama::Template;
use std::collections::BTreeSet;

#[derive(Template)]
#[template(path = "package.vhd", escape = "none")]
struct Package<'a> {
    name: &'a str,
    declarations: Vec<String>,
    functions: &'a BTreeSet<&'static str>,
}

/// Functions that only designs that call them have.
pub(super) const FUNCTIONS: [&str; 8] =
    ["flag", "known", "less", "choose", "negated_if", "abs_of", "append", "or_reduce"];

/// All names that the package may declare.
pub(super) fn names(types: &Types) -> Vec<String> {
    let functions = FUNCTIONS.iter().map(|name| (*name).to_owned());
    functions.chain(types.names()).chain(["numbers_t".to_owned()]).collect()
}

/// The text of the package of some entities.
pub(super) fn text(
    name: &str,
    types: &Types,
    functions: &BTreeSet<&'static str>,
    entities: &[(String, String)],
) -> String {
    let texts = entities.iter().map(|(_, text)| text.as_str());
    let package = Package { name, declarations: types.declarations(texts), functions };
    package.render().expect("the template renders")
}
