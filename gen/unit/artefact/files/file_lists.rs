//! The VHDL files of a design by what they are for: every list of files in every project comes from here.

use super::Prefix;

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

/// File names below the design's folder, each list in dependency order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLists {
    /// The package of constants for users.
    pub constants: String,
    /// The unit; its top is the last.
    pub core: Vec<String>,
    /// The stream wrapper.
    pub wrapper: String,
    /// The registers around it, if there are any.
    pub registers: Vec<String>,
    /// The entity around everything that is synthesised.
    pub top: String,
    /// The example design around the wrapper.
    pub example: [String; 3],
    /// Testbenches of the unit, the wrapper and the example, and of the registers.
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
        let entity = prefix.of("efsat_registers_tb");
        BenchFiles {
            file: format!("{entity}.vhd"),
            vectors: format!("{entity}.vec"),
            entity,
            what: "Testbench of the registers",
            target: "sim_registers",
        }
    }

    /// The files of the example.
    pub fn example(prefix: &Prefix) -> [String; 3] {
        ["uart_receiver", "uart_transmitter", "efsat_uart_top"].map(|entity| format!("example/{prefix}{entity}.vhd"))
    }

    /// The lists of a design whose entities have these files.
    pub fn new(core: Vec<String>, prefix: &Prefix) -> Self {
        let file = |folder: &str, entity: &str| format!("{folder}{prefix}{entity}.vhd");
        let bench = |entity, folder: &str, has_vectors, what, target| {
            let vectors = if has_vectors { format!("{prefix}{entity}.vec") } else { String::new() };
            BenchFiles { entity: prefix.of(entity), file: file(folder, entity), vectors, what, target }
        };
        Self {
            constants: file("", "efsat_constants"),
            core,
            wrapper: file("", "efsat_stream"),
            example: Self::example(prefix),
            registers: vec![],
            top: prefix.of("efsat_stream"),
            benches: vec![
                bench("efsat_tb", "", true, "Testbench of the unit", "sim"),
                bench("efsat_stream_tb", "", true, "Testbench of the stream wrapper", "sim_stream"),
                bench("efsat_uart_tb", "example/", false, "Testbench of the UART example", "sim_uart"),
            ],
        }
    }

    /// With registers around the wrapper.
    pub fn with_registers(mut self, prefix: &Prefix) -> Self {
        self.registers = Self::registers(prefix).into();
        self.top = prefix.of(Self::SHELL);
        self.benches.push(Self::registers_bench(prefix));
        self
    }

    /// What is synthesised: the unit and its wrapper, and the constants for what is around them.
    pub fn synthesised(&self) -> Vec<String> {
        let constants = std::iter::once(&self.constants);
        constants.chain(&self.core).chain([&self.wrapper]).chain(&self.registers).cloned().collect()
    }

    /// All files, testbenches last.
    pub fn all(&self) -> Vec<String> {
        let example = self.example.iter().cloned();
        let benches = self.benches.iter().map(|bench| bench.file.clone());
        self.synthesised().into_iter().chain(example).chain(benches).collect()
    }
}
