//! The VHDL files of a design by what they are for: every list of files in every project comes from here.

/// A testbench.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bench {
    /// Its entity.
    pub entity: &'static str,
    /// Its file.
    pub file: String,
    /// Its vector file, empty if it has none.
    pub vectors: &'static str,
    /// What it shows.
    pub what: &'static str,
    /// Its name as a target of a build tool.
    pub target: &'static str,
}

/// File names below the design's folder, each list in dependency order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLists {
    /// The unit; `efsat.vhd` is the last.
    pub core: Vec<String>,
    /// The stream wrapper.
    pub wrapper: &'static str,
    /// The example design around the wrapper.
    pub example: [&'static str; 3],
    /// Testbenches of the unit, the wrapper and the example.
    pub benches: [Bench; 3],
}

impl FileLists {
    /// The lists of a design whose entities have these files.
    pub fn new(core: Vec<String>) -> Self {
        let bench = |entity, folder: &str, vectors, what, target| {
            let file = format!("{folder}{entity}.vhd");
            Bench { entity, file, vectors, what, target }
        };
        Self {
            core,
            wrapper: "efsat_stream.vhd",
            example: ["example/uart_receiver.vhd", "example/uart_transmitter.vhd", "example/efsat_uart_top.vhd"],
            benches: [
                bench("efsat_tb", "", "efsat_tb.vec", "Testbench of the unit", "sim"),
                bench("efsat_stream_tb", "", "efsat_stream_tb.vec", "Testbench of the stream wrapper", "sim_stream"),
                bench("efsat_uart_tb", "example/", "", "Testbench of the UART example", "sim_uart"),
            ],
        }
    }

    /// What is synthesised: the unit and its wrapper.
    pub fn synthesised(&self) -> Vec<String> {
        self.core.iter().cloned().chain([self.wrapper.to_owned()]).collect()
    }

    /// All files, testbenches last.
    pub fn all(&self) -> Vec<String> {
        let example = self.example.iter().map(|&name| name.to_owned());
        let benches = self.benches.iter().map(|bench| bench.file.clone());
        self.synthesised().into_iter().chain(example).chain(benches).collect()
    }
}
