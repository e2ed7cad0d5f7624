//! The pages whose files a reader types: what stands there is what runs, and answers as printed.

use crate::book::text;
use crate::drop_in::{efsat, run};
use crate::tools::ghdl;
use std::fs;

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
    assert_eq!(efsat(dir, "generate --device xc7a100t-1 --out rtl"), printed[0]);
    let Some(ghdl) = ghdl() else { return };
    let names = ["collide.vhd", "collide_tb.vhd"];
    for (name, text) in names.iter().zip(blocks(&page, "vhdl")) {
        fs::write(dir.join(name), text).unwrap();
    }
    let list = fs::read_to_string(dir.join("rtl/files-synthesis.txt")).unwrap();
    let core: Vec<String> = list.lines().map(|name| format!("rtl/{name}")).collect();
    let files = core.iter().map(String::as_str).chain(names);
    run(dir, ghdl, &["-a", "--std=93", "--warn-error"].into_iter().chain(files).collect::<Vec<_>>());
    run(dir, ghdl, &["-e", "--std=93", "collide_tb"]);
    let said = run(dir, ghdl, &["-r", "--std=93", "collide_tb"]);
    assert_eq!(reports(&said), reports(printed[1]));
    assert_eq!(reports(&said).len(), 5);
}
