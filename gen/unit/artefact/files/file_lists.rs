//! The VHDL files of a design by what they are for: every list of files in every project comes from here.

use super::Prefix;
use super::core::Core;

/// A testbench.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BenchFiles {
    /// Its entity.
    pub entity: String,
    /// Its file.
    pub file: String,
    /// Its vector file, empty if it has none.
    pub vectors: String,
    /// What it shows.
    pub what: &'static str,
    /// Its name as a target of a build tool.
    pub target: &'static str,
}

impl BenchFiles {
    /// A testbench with vectors.
    pub fn new(entity: &str, what: &'static str, target: &'static str, prefix: &Prefix) -> Self {
        let entity = prefix.of(entity);
        Self { file: format!("{entity}.vhd"), vectors: format!("{entity}.vec"), entity, what, target }
    }
}

/// File names below the design's folder, each list in dependency order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLists {
    /// What is synthesised, with the constants for what is around.
    pub synthesised: Vec<String>,
    /// The entity around everything that is synthesised.
    pub top: String,
    /// The example design around the core, if there is one.
    pub example: Vec<String>,
    /// Testbenches; those of the registers are the last.
    pub benches: Vec<BenchFiles>,
}

impl FileLists {
    /// The file that lists what is synthesised.
    pub const SYNTHESISED: &str = "files-synthesis.txt";

    /// The entity around core and registers, without a prefix.
    pub const SHELL: &str = "efsat_shell";

    /// The files of the registers that are synthesised, in dependency order; the shell is the last.
    pub fn registers(prefix: &Prefix) -> [String; 3] {
        ["efsat_register_map", "efsat_registers", Self::SHELL].map(|name| format!("{prefix}{name}.vhd"))
    }

    /// The testbench of the registers.
    pub fn registers_bench(prefix: &Prefix) -> BenchFiles {
        BenchFiles::new("efsat_registers_tb", "Testbench of the registers", "sim_registers", prefix)
    }

    /// The files of the example.
    pub fn example(prefix: &Prefix) -> [String; 3] {
        ["uart_receiver", "uart_transmitter", "efsat_uart_top"].map(|entity| format!("example/{prefix}{entity}.vhd"))
    }

    /// The lists of a core whose entities have these files; without an example.
    pub fn new(core: &Core, synthesised: Vec<String>, benches: Vec<BenchFiles>, prefix: &Prefix) -> Self {
        Self { synthesised, top: prefix.of(core.entity), example: vec![], benches }
    }

    /// With an example around the core.
    pub fn with_example(mut self, prefix: &Prefix) -> Self {
        self.example = Self::example(prefix).into();
        self
    }

    /// With registers around the core.
    pub fn with_registers(mut self, prefix: &Prefix) -> Self {
        self.synthesised.extend(Self::registers(prefix));
        self.top = prefix.of(Self::SHELL);
        self.benches.push(Self::registers_bench(prefix));
        self
    }

    /// All files, testbenches last.
    pub fn all(&self) -> Vec<String> {
        let benches = self.benches.iter().map(|bench| &bench.file);
        self.synthesised.iter().chain(&self.example).chain(benches).cloned().collect()
    }
}
