//! GHDL in a folder: files are written, analysed, elaborated and run.

use super::{replaced, skip};
use efsat::artefact::FileSet;
use efsat_hardware::tools::{self, Tool};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{LazyLock, Mutex, OnceLock};
use tempfile::TempDir;

/// The GHDL of tests with short runs, that which compiles fastest; where none is installed none, which is said.
pub fn ghdl() -> Option<&'static Tool> {
    static FOUND: LazyLock<Option<Tool>> = LazyLock::new(|| tools::ghdl(true));
    or_skip(&FOUND)
}

/// That of tests with long runs, which simulates fastest.
pub fn ghdl_of_long_runs() -> Option<&'static Tool> {
    static FOUND: LazyLock<Option<Tool>> = LazyLock::new(|| tools::ghdl(false));
    or_skip(&FOUND)
}

fn or_skip(found: &'static Option<Tool>) -> Option<&'static Tool> {
    if found.is_none() {
        skip("GHDL is not installed");
    }
    found.as_ref()
}

/// Folders that are kept to the end of this run. Those of runs that have ended are deleted.
fn kept() -> &'static Path {
    static KEPT: LazyLock<PathBuf> = LazyLock::new(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ghdl");
        let here = all.join(std::process::id().to_string());
        std::fs::create_dir_all(&here).unwrap();
        let ended = |run: &Path| Path::new("/proc/self").exists() && !Path::new("/proc").join(run).exists();
        for run in std::fs::read_dir(&all).unwrap().flatten().filter(|run| ended(Path::new(&run.file_name()))) {
            // Another run may delete it, too.
            let _ = std::fs::remove_dir_all(run.path());
        }
        here
    });
    &KEPT
}

/// A folder in which GHDL works, in strict VHDL-93.
pub struct Ghdl {
    tool: &'static Tool,
    dir: PathBuf,
    /// Deletes the folder at the end.
    _scratch: Option<TempDir>,
}

impl Ghdl {
    /// In a new folder.
    pub fn new(tool: &'static Tool) -> Self {
        let scratch = tempfile::tempdir().unwrap();
        Self { tool, dir: scratch.path().to_owned(), _scratch: Some(scratch) }
    }

    /// In a folder that is there.
    pub fn at(tool: &'static Tool, dir: &Path) -> Self {
        Self { tool, dir: dir.to_owned(), _scratch: None }
    }

    /// In a new folder with these files, names and texts, analysed in their order. They come in stages: files that are the same up
    /// to the end of a stage are analysed once in a run of the tests.
    pub fn analysed(tool: &'static Tool, stages: &[Vec<(&str, &str)>]) -> Self {
        type Analysed = HashMap<String, &'static OnceLock<Ghdl>>;
        static ANALYSED: LazyLock<Mutex<Analysed>> = LazyLock::new(Mutex::default);
        let mut key = tool.path.display().to_string();
        let mut last: Option<&Self> = None;
        for files in stages.iter().filter(|files| !files.is_empty()) {
            files.iter().for_each(|(name, text)| key.extend(["\n", name, "\n", text]));
            let place: &OnceLock<Self> =
                ANALYSED.lock().unwrap().entry(key.clone()).or_insert_with(|| Box::leak(Box::default()));
            last = Some(place.get_or_init(|| {
                let made = Self { tool, dir: tempfile::tempdir_in(kept()).unwrap().keep(), _scratch: None };
                if let Some(last) = last {
                    last.copy_to(&made.dir);
                }
                files.iter().for_each(|(name, text)| made.write(name, text));
                made.analyse(&files.iter().map(|(name, _)| *name).collect::<Vec<_>>());
                made
            }));
        }
        last.expect("files").copy()
    }

    /// A copy of the folder, with all that was analysed in it.
    pub fn copy(&self) -> Self {
        let copy = Self::new(self.tool);
        self.copy_to(&copy.dir);
        copy
    }

    /// A copy in which a file is changed from one text to another, and the files as they are there: of a list, in which files come
    /// behind those that they depend on, it is analysed, and what depends on it.
    pub fn changed(&self, files: &FileSet, list: &[&str], (name, from, to): (&str, &str, &str)) -> (Self, FileSet) {
        let mut files = files.clone();
        files.insert(name, replaced(files.get(name).unwrap(), from, to));
        let copy = self.copy();
        copy.write(name, files.get(name).unwrap());
        let mut changed: Vec<&str> = vec![];
        for file in list {
            let uses = |unit: &&str| {
                let unit = unit.trim_end_matches(".vhd");
                files.get(file).unwrap().contains(&format!("work.{unit}"))
            };
            if *file == name || changed.iter().any(uses) {
                changed.push(file);
            }
        }
        assert!(!changed.is_empty(), "{name}: no file of the list");
        copy.analyse(&changed);
        (copy, files)
    }

    fn copy_to(&self, dir: &Path) {
        super::run(&self.dir, "cp", &["-a", ".", dir.to_str().unwrap()]);
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.dir.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.dir.join(name)).unwrap()
    }

    fn command(&self, step: &str, args: &[&str]) -> Command {
        let mut command = Command::new(&self.tool.path);
        command.args([step, "--std=93"]).args(args).current_dir(&self.dir);
        command
    }

    /// Runs GHDL; whether it succeeded, and what it says.
    pub fn call(&self, step: &str, args: &[&str]) -> (bool, String) {
        let output = self.command(step, args).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        (output.status.success(), text)
    }

    /// Analyses files in order, with warnings as errors. What is optimised takes three times as long to compile, and runs no faster:
    /// most of a run is in the packages of IEEE, which are compiled already.
    pub fn analyse(&self, names: &[impl AsRef<str>]) {
        let names = names.iter().map(AsRef::as_ref);
        let compiles = ["ghdl-llvm", "ghdl-gcc"].contains(&self.tool.name().as_str());
        let options = ["--warn-error"].into_iter().chain(compiles.then_some("-O0"));
        let (fine, text) = self.call("-a", &options.chain(names).collect::<Vec<_>>());
        assert!(fine, "{text}");
    }

    pub fn elaborate(&self, entity: &str) {
        let (fine, text) = self.call("-e", &[entity]);
        assert!(fine, "{entity}: {text}");
    }

    /// Elaborates and runs a testbench; whether it ended well, and what it says.
    pub fn run(&self, entity: &str, options: &[&str]) -> (bool, String) {
        self.elaborate(entity);
        self.call("-r", &[&[entity], options].concat())
    }

    /// As [`Ghdl::run`], and goes on without waiting for its end: it reads standard input and answers on standard output.
    pub fn start(&self, entity: &str, options: &[&str]) -> Child {
        self.elaborate(entity);
        let mut command = self.command("-r", &[&[entity], options].concat());
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap()
    }
}
