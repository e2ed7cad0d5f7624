//! The ready designs and a ready engine, as they lie in the repository: each in a folder of its own, and an index.

use crate::artefact::{EngineDesign, engine_design_files, samples};
use crate::params::EngineParams;
use askama::Template;
use efsat_hardware::estimate;
use efsat_unit::artefact::{DesignFilesError, FileSet, Packaging, Prefix, design_files_with, ready_designs};
use efsat_unit::design::Design;
use efsat_unit::design::top::DesignError;
use efsat_unit::params::Params;
use efsat_unit::parts::manifest;

/// Why the ready designs cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ReadyError {
    /// Parameters out of range, or an unknown device.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A name that is not legal VHDL, or a breach of the rules of the target.
    #[error(transparent)]
    Files(#[from] DesignFilesError),
}

/// A row of the index.
struct Row {
    name: &'static str,
    what: &'static str,
    options: &'static str,
    multipliers: usize,
    luts: u64,
    flip_flops: u64,
    interval: usize,
    latency: usize,
    million_pairs: String,
}

#[derive(Template)]
#[template(path = "ready-readme.md")]
struct Index {
    version: &'static str,
    device: &'static str,
    frequency: u32,
    rows: Vec<Row>,
    engines: Vec<EngineRow>,
}

/// What the index says of an engine.
struct EngineRow {
    name: &'static str,
    options: &'static str,
    multipliers: usize,
    block_rams: u64,
    expansion_clocks: usize,
    pair_clocks: usize,
}

/// How many ready engines there are.
#[doc(hidden)]
pub const ENGINES: usize = 2;

/// The folders of the ready engines, their options and the units in them.
fn engines() -> [(&'static str, &'static str, Params); ENGINES] {
    let usual = EngineParams::default().unit();
    [("engine", "--engine", usual), ("engine-axes", "--engine --method axes", Params::default())]
}

/// All ready designs, a folder each, with an index and a manifest of the whole. `command_line` says how a design that is
/// packaged so is generated.
///
/// # Errors
/// A defect of the generator; see [`ReadyError`].
pub fn ready_files(command_line: impl Fn(&Params, &Packaging) -> String) -> Result<FileSet, ReadyError> {
    let (mut set, mut rows) = (FileSet::default(), vec![]);
    for ready in ready_designs() {
        let design = Design::new(&ready.params, false)?;
        let packaging = Packaging { stream_width: ready.stream_width, ..Packaging::default() };
        let files = design_files_with(&design, &packaging, &command_line(&ready.params, &packaging))?;
        set.insert_folder(ready.name, files);
        let cells = estimate::whole(&design.top, design.device);
        rows.push(Row {
            name: ready.name,
            what: ready.what,
            options: ready.options,
            multipliers: design.top.multipliers(),
            luts: cells.luts + cells.memory_luts,
            flip_flops: cells.flip_flops,
            interval: design.interval,
            latency: design.latency,
            million_pairs: format!("{:.1}", f64::from(design.params.frequency) / design.interval as f64),
        });
    }
    let params = Params::default();
    let device = Design::check(&params)?.name;
    let engines = engines().into_iter().map(|(name, options, unit)| engine(&mut set, name, options, &unit));
    let engines = engines.collect::<Result<_, _>>()?;
    let index = Index { version: env!("CARGO_PKG_VERSION"), device, frequency: params.frequency, rows, engines };
    set.insert("README.md", index.render().expect("the template renders"));
    let whole = whole_manifest(&set);
    set.insert(manifest::NAME, whole);
    Ok(set)
}

/// Adds the engine around a unit.
fn engine(
    set: &mut FileSet,
    name: &'static str,
    options: &'static str,
    unit: &Params,
) -> Result<EngineRow, ReadyError> {
    let design = EngineDesign::new(&EngineParams::default(), unit)?;
    let vectors = samples::text(&design).map_err(DesignError::from)?;
    let files = engine_design_files(&design, &Prefix::default(), &design.command_line(), &vectors)?;
    set.insert_folder(name, files);
    Ok(EngineRow {
        name,
        options,
        multipliers: design.multipliers().iter().sum(),
        block_rams: design.control(design.unit.device).whole().block_rams,
        expansion_clocks: design.volume.interval,
        pair_clocks: design.unit.interval,
    })
}

/// The manifest of the ready designs: their files alone, for each folder has a manifest of its own.
fn whole_manifest(files: &FileSet) -> String {
    let manifest = serde_json::json!({ "SPDX-License-Identifier": env!("CARGO_PKG_LICENSE"), "generator": manifest::generator(), "files": manifest::digests(files) });
    serde_json::to_string_pretty(&manifest).expect("keys are strings")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ready_design_is_complete() {
        let set = ready_files(|params, packaging| format!("{} {packaging:?}", params.command_line())).unwrap();
        for ready in ready_designs() {
            for file in
                ["README.md", "efsat.vhd", "efsat_stream.vhd", "efsat_tb.vec", "manifest.json", "ise/project.tcl"]
            {
                assert!(set.get(&format!("{}/{file}", ready.name)).is_some(), "{}/{file}", ready.name);
            }
            let row = format!("| [{0}]({0}/README.md) |", ready.name);
            assert!(set.get("README.md").unwrap().contains(&row), "{row}");
        }
        for (name, ..) in engines() {
            for file in ["README.md", "efsat_engine.vhd", "efsat_engine_tb.vec", "manifest.json"] {
                assert!(set.get(&format!("{name}/{file}")).is_some(), "{name}/{file}");
            }
        }
        assert_eq!(manifest::files(set.get(manifest::NAME).unwrap()).unwrap().len(), set.len() - 1);
    }
}
