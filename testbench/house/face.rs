//! Counts what the documentation of a crate shows.

use super::paths;
use std::collections::{BTreeMap, BTreeSet};

/// What the documentation of a crate shows of its sources, given as paths below its folder and code without comments and tests:
/// items by the paths of their modules, functions of a type by its name.
///
/// A line counts that begins, behind its blanks, with `pub` and the word of a function, type, trait, constant or module. It is
/// shown
/// * outside of `impl`: in a module that `pub mod` leads to, or where a `pub use` of such a module names it;
/// * in an `impl`: if a type of that name is shown.
///
/// Nothing behind `#[doc(hidden)]` is shown, nor what only such modules name. Fields, variants, functions of traits, and names
/// that come from another crate do not count.
pub fn shown(sources: &[(String, String)]) -> Vec<String> {
    let mut modules = BTreeMap::new();
    for (path, code) in sources {
        let mut module: Vec<&str> = path.trim_end_matches(".rs").split('/').collect();
        if module.last().is_some_and(|last| ["mod", "lib"].contains(last)) {
            module.pop();
        }
        read(&module.into_iter().map(str::to_owned).collect::<Vec<_>>(), code, &mut modules);
    }
    let mut items = BTreeSet::new();
    let mut open = vec![vec![]];
    while let Some(path) = open.pop() {
        let Some(module) = modules.get(&path) else { continue };
        for (name, is_module) in &module.items {
            let item = [&path[..], std::slice::from_ref(name)].concat();
            if *is_module && !items.contains(&item) {
                open.push(item.clone());
            }
            items.insert(item);
        }
        for used in &module.uses {
            let used = [if used[0] == "crate" { &[][..] } else { &path[..] }, used].concat();
            let used: Vec<String> = used.into_iter().filter(|step| step != "crate" && step != "self").collect();
            let Some((name, around)) = used.split_last() else { continue };
            let known = modules.get(around).and_then(|module| module.all.get(name));
            match known {
                Some(true) if !items.contains(&used) => open.push(used.clone()),
                None => continue,
                _ => {}
            }
            items.insert(used);
        }
    }
    let types: BTreeSet<&str> = items.iter().filter_map(|item| item.last()).map(String::as_str).collect();
    let methods = modules.iter().flat_map(|(path, module)| module.methods.iter().map(move |method| (path, method)));
    let methods = methods.filter(|(_, (of, _))| types.contains(of.as_str()));
    let methods = methods.map(|(path, (of, name))| format!("{}::{of}.{name}", path.join("::")));
    items.iter().map(|item| item.join("::")).chain(methods).collect()
}

/// What a module has: what it shows itself with whether that is a module, all that is public in it, paths of `pub use`, and
/// functions by their types.
#[derive(Default)]
struct Module {
    items: Vec<(String, bool)>,
    all: BTreeMap<String, bool>,
    uses: Vec<Vec<String>>,
    methods: Vec<(String, String)>,
}

/// Reads a module, and the modules that are written in it.
fn read(path: &[String], code: &str, modules: &mut BTreeMap<Vec<String>, Module>) {
    const KINDS: [&str; 8] = ["fn", "struct", "enum", "trait", "const", "static", "type", "mod"];
    let ident = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut module = Module::default();
    let (mut hidden, mut of) = (false, None);
    let mut lines = code.lines();
    while let Some(line) = lines.next() {
        let text = line.trim_start();
        if text.starts_with("#[") {
            hidden |= text.starts_with("#[doc(hidden)]");
            continue;
        }
        let skipped = std::mem::take(&mut hidden);
        if text.starts_with("impl") && line == text {
            let head = text.split(" where ").next().unwrap_or(text);
            let head = head.rsplit(" for ").next().unwrap_or(head).trim_start_matches("impl");
            // Behind the parameters of the block.
            let depth = |depth: &mut i32, c: char| {
                *depth += i32::from(c == '<') - i32::from(c == '>');
                Some((*depth, c))
            };
            let outside = head.chars().scan(0, depth).filter(|(depth, c)| *depth == 0 && *c != '>').map(|(_, c)| c);
            of = (!skipped).then(|| ident(outside.collect::<String>().trim_start()));
            continue;
        }
        if line == "}" {
            of = None;
        }
        let Some(rest) = text.strip_prefix("pub ") else { continue };
        if let Some(tree) = rest.strip_prefix("use ") {
            let mut tree = tree.to_owned();
            while !tree.contains(';') {
                tree += lines.next().unwrap_or(";");
            }
            if !skipped {
                module.uses.extend(paths(&format!("use {tree}")));
            }
            continue;
        }
        let rest = rest.strip_prefix("const fn").map_or(rest.to_owned(), |rest| format!("fn{rest}"));
        let Some((kind, name)) = rest.split_once(' ').filter(|(kind, _)| KINDS.contains(kind)) else { continue };
        let name = ident(name);
        let inner = kind == "mod" && rest.ends_with('{');
        if inner {
            let body: Vec<&str> =
                lines.by_ref().take_while(|line| *line != "}").map(|line| line.trim_start_matches("    ")).collect();
            read(&[path, std::slice::from_ref(&name)].concat(), &body.join("\n"), modules);
        }
        match &of {
            Some(of) if line != text => module.methods.extend((!skipped).then(|| (of.clone(), name))),
            _ => {
                module.all.insert(name.clone(), kind == "mod");
                module.items.extend((!skipped).then_some((name, kind == "mod")));
            }
        }
    }
    modules.insert(path.to_vec(), module);
}
