//! All files of a generated design, as one value.

use super::{ise, manifest, origin, testbench, vectors, vhdl_files, FileSet, Stimulus};
use crate::design::Design;
use crate::vhdl::lint::{lint, Finding};
use crate::vhdl::Clash;
use askama::Template;

/// Pairs in the vector file: some seconds of simulation.
const PAIRS: usize = 256;

/// Why a design cannot be printed: a defect of the generator, never of the parameters.
#[derive(Debug, thiserror::Error)]
pub enum DesignFilesError {
    /// A name that is no legal VHDL.
    #[error("names: {0}")]
    Name(#[from] Clash),
    /// A text that the target's tools would not take.
    #[error("lint: {0}")]
    Lint(Finding),
}

/// A line of the table of files.
struct Described {
    name: String,
    what: String,
}

#[derive(Template)]
#[template(path = "rtl-readme.md", escape = "none")]
struct Readme<'a> {
    version: &'static str,
    command_line: &'a str,
    interval: usize,
    latency: usize,
    multipliers: usize,
    register_bits: u64,
    frequency: u32,
    device: &'static str,
    delays: &'static str,
    testbench: &'static str,
    files: Vec<Described>,
    projects: Vec<ise::Project>,
}

/// Sources, testbench, vectors, ISE projects, a README and the manifest. Equal designs and command lines give equal
/// bytes.
///
/// # Errors
/// A name in the design that is no legal VHDL, or a breach of the [rules](crate::vhdl::lint) of the target.
pub fn design_files(design: &Design, command_line: &str) -> Result<FileSet, DesignFilesError> {
    let mut set = FileSet::default();
    let mut described = vec![];
    let mut sources = vec![];
    let modules = design.top.hierarchy();
    for ((name, text), module) in vhdl_files(design, command_line)?.into_iter().zip(&modules) {
        described.push(Described { name: name.clone(), what: first_sentence(&module.doc) });
        set.insert(name.clone(), text);
        sources.push(name);
    }
    let texts: Vec<(&str, &str)> =
        sources.iter().filter_map(|name| set.get(name).map(|text| (name.as_str(), text))).collect();
    if let Some(finding) = lint(&texts).into_iter().next() {
        return Err(DesignFilesError::Lint(finding));
    }
    ise::add(&mut set, design, command_line, &sources);

    let bench = format!("{}.vhd", testbench::NAME);
    let vector_file = format!("{}.vec", testbench::NAME);
    set.insert(&bench, testbench::text(design, &origin(command_line)));
    set.insert(&vector_file, vectors::text(&design.params, &Stimulus::random(&design.params, PAIRS, 1)));
    sources.push(bench.clone());
    set.insert("files.txt", sources.join("\n"));

    let mut describe =
        |name: &str, what: &str| described.push(Described { name: name.to_owned(), what: what.to_owned() });
    describe(&bench, "Testbench, for simulation only.");
    describe(&vector_file, &format!("{PAIRS} random pairs under random poses, with the reference model's answers."));
    describe("files.txt", "All VHDL files in dependency order, the testbench last.");
    describe(manifest::NAME, "Parameters, ports, number formats, latency, and a SHA-256 per file, for programs.");
    for project in ise::projects() {
        describe(&project.folder, &format!("Project for {} ({}).", project.part, project.releases));
    }
    set.insert("README.md", readme(design, command_line, described));
    let manifest = manifest::text(design, command_line, &set);
    set.insert(manifest::NAME, manifest);
    Ok(set)
}

/// The first sentence of a module's description, as a cell of a table.
fn first_sentence(doc: &[String]) -> String {
    let paragraph: Vec<&str> = doc.iter().map(|line| line.trim()).take_while(|line| !line.is_empty()).collect();
    let text = paragraph.join(" ").replace('|', "\\|");
    match text.split_once(". ") {
        Some((sentence, _)) => format!("{sentence}."),
        None => text,
    }
}

fn readme(design: &Design, command_line: &str, files: Vec<Described>) -> String {
    let readme = Readme {
        version: env!("CARGO_PKG_VERSION"),
        command_line,
        interval: design.interval,
        latency: design.latency,
        multipliers: design.top.multipliers(),
        register_bits: design.top.register_bits(),
        frequency: design.params.frequency,
        device: design.device.name,
        delays: design.device.source,
        testbench: testbench::NAME,
        files,
        projects: ise::projects(),
    };
    readme.render().expect("the template renders")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;

    fn default_files() -> FileSet {
        let params = Params::default();
        design_files(&Design::new(&params, false).unwrap(), &params.command_line()).unwrap()
    }

    #[test]
    fn equal_parameters_give_equal_bytes() {
        assert_eq!(default_files(), default_files());
    }

    #[test]
    fn every_file_says_where_it_comes_from() {
        let command_line = Params::default().command_line();
        for (name, text) in default_files().iter() {
            assert!(text.is_ascii() && text.ends_with('\n') && !text.ends_with("\n\n"), "{name}");
            if name.ends_with(".vhd") {
                let lines: Vec<&str> = text.lines().take(3).collect();
                assert_eq!(lines[1], format!("-- Generated by efsat {}; do not edit.", env!("CARGO_PKG_VERSION")));
                assert_eq!(lines[2], format!("-- {command_line}"), "{name}");
            }
        }
    }

    #[test]
    fn lists_are_in_dependency_order() {
        let set = default_files();
        let order: Vec<&str> = set.get("files.txt").unwrap().lines().collect();
        assert_eq!(order[order.len() - 2..], ["efsat.vhd", "efsat_tb.vhd"]);
        for (i, name) in order.iter().enumerate() {
            let text = set.get(name).unwrap();
            for later in &order[i..] {
                let entity = later.trim_end_matches(".vhd");
                assert!(!text.contains(&format!("entity work.{entity}\n")), "{name} uses {entity}");
            }
        }
        let list = set.get("ise/virtex2/efsat.prj").unwrap();
        let named: Vec<String> =
            order[..order.len() - 1].iter().map(|name| format!("vhdl work \"../../{name}\"")).collect();
        assert_eq!(list.lines().collect::<Vec<_>>(), named);
    }

    #[test]
    fn projects_name_part_and_clock() {
        let set = default_files();
        assert!(set.get("ise/virtex2/efsat.xst").unwrap().contains("-p xc2v6000-4-bf957\n"));
        assert!(set.get("ise/spartan6/efsat.xst").unwrap().contains("-p xc6slx150-3-fgg676\n"));
        assert!(set.get("ise/virtex2/efsat.ucf").unwrap().contains("PERIOD \"clk\" 100 MHz HIGH 50 %;"));
        assert!(set.get("ise/virtex2/project.tcl").unwrap().contains("project new efsat.ise\n"));
        assert!(set.get("ise/spartan6/project.tcl").unwrap().contains("project new efsat.xise\n"));
    }
}
