//! The pages for readers: every relative link leads somewhere, the index and the summary of the book name every page, and the
//! README stays short.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Lines that a README may have.
const README_LINES: usize = 130;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages that are read: README, CONTRIBUTING, CHANGELOG and docs/*.md, by their path below the repository.
pub fn pages() -> Vec<String> {
    let mut pages: Vec<String> = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(str::to_owned).into();
    let entries = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().file_name());
    let names = entries.map(|name| name.to_str().unwrap().to_owned());
    pages.extend(names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}")));
    pages.sort();
    pages
}

pub fn text(page: &str) -> String {
    fs::read_to_string(root().join(page)).unwrap()
}

/// Lines of a page that are no code block.
pub fn prose(text: &str) -> Vec<&str> {
    let mut lines = vec![];
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            lines.push(line);
        }
    }
    lines
}

/// A paragraph without what stands between backticks.
fn without_code(paragraph: &str) -> String {
    paragraph.split('`').step_by(2).collect()
}

/// Targets of the links and pictures of a page. Links and code may go on in the next line of a paragraph.
fn targets(text: &str) -> Vec<String> {
    let prose = prose(text).join("\n");
    let paragraphs: Vec<String> = prose.split("\n\n").map(without_code).collect();
    let prose = paragraphs.join("\n\n");
    let ends = prose.split("](").skip(1);
    ends.map(|rest| rest.split(')').next().unwrap().trim().to_owned()).collect()
}

/// The anchor that a forge gives a heading: lower case, blanks to hyphens, without other signs.
fn slug(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Anchors of a page; a heading that comes again has a number behind it.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in prose(text) {
        let heading = line.trim_start_matches('#');
        if line.starts_with('#') && heading.starts_with(' ') {
            let slug = slug(heading);
            let again = (1..).map(|n| format!("{slug}-{n}"));
            let free = std::iter::once(slug.clone()).chain(again).find(|name| !found.contains(name));
            found.insert(free.unwrap());
        }
    }
    found
}

/// `a/b/../c` is `a/c`. None if it leads out of the repository.
fn normal(path: &Path) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => found.push(name),
            Component::ParentDir => {
                if !found.pop() {
                    return None;
                }
            }
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(found)
}

/// What is wrong with a link of a page; nothing if it leads somewhere. Links to the web are not followed.
fn fault(page: &str, text: &str, target: &str) -> Option<String> {
    if target.starts_with("https://") || target.starts_with("http://") {
        return None;
    }
    let (file, anchor) = target.split_once('#').map_or((target, None), |(file, anchor)| (file, Some(anchor)));
    let folder = Path::new(page).parent().unwrap();
    let path = if file.is_empty() { Some(PathBuf::from(page)) } else { normal(&folder.join(file)) };
    let Some(path) = path.filter(|path| root().join(path).exists()) else {
        return Some(format!("{page}: {target}: no such file"));
    };
    let anchor = anchor?;
    let there = if file.is_empty() { text.to_owned() } else { fs::read_to_string(root().join(path)).unwrap() };
    (!anchors(&there).contains(anchor)).then(|| format!("{page}: {target}: no such heading"))
}

fn faults(page: &str, text: &str) -> Vec<String> {
    targets(text).iter().filter_map(|target| fault(page, text, target)).collect()
}

/// Pages of docs/ that a list of links (the index or the summary, which are in docs/) does not name.
fn not_named(list: &str, pages: &[String]) -> Vec<String> {
    let targets = targets(list);
    let named: BTreeSet<&str> = targets.iter().map(|target| target.split('#').next().unwrap()).collect();
    let of_docs = pages.iter().filter_map(|page| page.strip_prefix("docs/"));
    let others = of_docs.filter(|name| !["README.md", "SUMMARY.md"].contains(name));
    others.filter(|name| !named.contains(name)).map(str::to_owned).collect()
}

#[test]
fn every_relative_link_leads_somewhere() {
    let faults: Vec<String> = pages().iter().flat_map(|page| faults(page, &text(page))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn index_and_summary_name_every_page() {
    for list in ["docs/README.md", "docs/SUMMARY.md"] {
        let missing = not_named(&text(list), &pages());
        assert!(missing.is_empty(), "{list}: {missing:?}");
    }
}

/// Pages, by their paths below the repository, to which a page has links.
fn linked_pages(page: &str, text: &str) -> BTreeSet<String> {
    let folder = Path::new(page).parent().unwrap();
    let targets = targets(text).into_iter().map(|target| target.split('#').next().unwrap().to_owned());
    let local = targets.filter(|target| target.ends_with(".md") && !target.contains("://"));
    local.filter_map(|target| normal(&folder.join(target))).map(|path| path.to_str().unwrap().to_owned()).collect()
}

/// mdBook renders the pages of the summary alone, so a link from one of them to another page would lead nowhere.
#[test]
fn the_book_has_every_page_that_its_pages_link_to() {
    let summary = linked_pages("docs/SUMMARY.md", &text("docs/SUMMARY.md"));
    let linked = summary.iter().flat_map(|page| linked_pages(page, &text(page)));
    let missing: BTreeSet<String> = linked.filter(|page| !summary.contains(page)).collect();
    assert!(missing.is_empty(), "docs/SUMMARY.md: {missing:?}");
}

#[test]
fn the_readme_is_short_and_names_both_commands() {
    let readme = text("README.md");
    // Without the marks of tables, which no reader sees.
    let mut lines: Vec<&str> = readme.lines().filter(|line| !line.starts_with("<!-- ")).collect();
    lines.dedup();
    assert!(lines.len() <= README_LINES, "{} lines", lines.len());
    assert!(readme.contains("./scripts/demo") && readme.contains("./scripts/test"));
}

/// Every check of this file is shown something that it has to complain of.
#[test]
fn the_checks_can_fail() {
    let page = "# A page\n## 7.1 Two `x` words, again\n[a](#71-two-x-words-again) [b](#none) [c](README.md#b)\n\
                ![d](no.png) `[e](no.md)` [f\ng](../no.md) [h](https://example.org) [i](SUMMARY.md) [j](/etc)\n\
                ```sh\n# [k](no.sh)\n```\n[l](../../no)\n";
    let expected = ["#none", "README.md#b", "no.png", "../no.md", "/etc", "../../no"];
    let found = faults("docs/faq.md", page);
    let found: Vec<&str> = found.iter().map(|fault| fault.split(": ").nth(1).unwrap()).collect();
    assert_eq!(found, expected);

    let twice: Vec<String> = anchors("# A\n## A\n### B-c_d (e)\n#no\n").into_iter().collect();
    assert_eq!(twice, ["a", "a-1", "b-c_d-e"]);

    let linked: Vec<String> = linked_pages("docs/faq.md", page).into_iter().collect();
    assert_eq!(linked, ["docs/README.md", "docs/SUMMARY.md", "no.md"]);

    let pages = ["README.md", "docs/README.md", "docs/x.md", "docs/y.md"].map(str::to_owned);
    assert_eq!(not_named("[x](x.md#part)", &pages), ["y.md"]);
}
