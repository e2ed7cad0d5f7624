//! The pages whose files a reader types: what stands there is what runs, and answers as printed.

use crate::book::text;
use crate::tools::program::succeeds;
use crate::tools::{Ghdl, ghdl};

/// The blocks of a language on a page.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let opening = format!("```{language}\n");
    page.split(opening.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// What is reported of pairs, without the place in the file.
fn reports(said: &str) -> Vec<&str> {
    said.lines().filter_map(|line| line.split_once(": pair ")).map(|(_, report)| report).collect()
}

#[test]
fn the_core_answers_as_its_page_prints() {
    let page = text("docs/core-in-thirty-minutes.md");
    let printed = blocks(&page, "text");
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    assert_eq!(succeeds(dir, "generate --device xc7a100t-1 --out rtl"), printed[0]);
    let Some(tool) = ghdl() else { return };
    let ghdl = Ghdl::at(tool, dir);
    let mut files: Vec<String> =
        ghdl.read("rtl/files-synthesis.txt").lines().map(|name| format!("rtl/{name}")).collect();
    for (name, text) in ["collide.vhd", "collide_tb.vhd"].into_iter().zip(blocks(&page, "vhdl")) {
        ghdl.write(name, text);
        files.push(name.to_owned());
    }
    ghdl.analyse(&files);
    let (fine, said) = ghdl.run("collide_tb", &[]);
    assert!(fine, "{said}");
    assert_eq!((reports(&said).len(), reports(&said)), (5, reports(printed[1])));
}
