//! Device models: what an operation of a given width takes on a target part, in nanoseconds and in parts.
//!
//! The Virtex-II figures are read from public XST 10.1.03 reports for xc2v6000-4 (speed data PRODUCTION 1.121): LUT
//! 0.439 ns, carry 0.053 ns a bit, flip-flop 0.568 ns clock to output and 0.370 ns set-up, nets of fan-out 1 and 2-3
//! 0.61 and 0.83 ns, multiplier output bit k after 3.111 + 0.207 k ns. The split of a pipelined MULT18X18S in set-up
//! and clock-to-output was never published in such a report; a product therefore takes as many registers as its
//! combinational delay needs. The other parts are estimates after their data sheets and say so.

pub mod resources;

pub use resources::Resources;

/// A target part.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Name on the command line.
    pub name: &'static str,
    /// What the project files call it: family, device, package, speed grade.
    pub part: Part,
    /// Hardware multipliers on the part.
    pub multipliers: u32,
    /// Where the figures come from.
    pub source: &'static str,
    /// Clock to output of a flip-flop.
    clock_to_output: f64,
    /// Set-up of a flip-flop.
    setup: f64,
    /// One LUT.
    lut: f64,
    /// A net with few loads.
    net: f64,
    /// A net with many loads (select lines).
    wide_net: f64,
    /// Entering and leaving a carry chain, LUT included.
    carry: f64,
    /// One bit of carry.
    carry_bit: f64,
    /// A product's bit k: base + k * step.
    product: (f64, f64),
    /// Inputs of a LUT.
    lut_inputs: u32,
}

/// Names of a part in vendor project files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Family, as `xtclsh` takes it.
    pub family: &'static str,
    /// Device.
    pub device: &'static str,
    /// Package.
    pub package: &'static str,
    /// Speed grade with its dash.
    pub speed: &'static str,
}

/// A multiplier takes signed operands of at most this many bits.
pub const MULTIPLIER_BITS: u32 = 18;

const DEVICES: [Device; 2] = [
    Device {
        name: "xc2v6000-4",
        part: Part { family: "Virtex2", device: "xc2v6000", package: "bf957", speed: "-4" },
        multipliers: 144,
        source: "public XST 10.1.03 reports for xc2v6000-4",
        clock_to_output: 0.568,
        setup: 0.370,
        lut: 0.439,
        net: 0.83,
        wide_net: 1.5,
        carry: 2.011,
        carry_bit: 0.053,
        product: (3.111, 0.207),
        lut_inputs: 4,
    },
    Device {
        name: "xc6slx150-3",
        part: Part { family: "Spartan6", device: "xc6slx150", package: "fgg676", speed: "-3" },
        multipliers: 180,
        source: "estimated after the Spartan-6 data sheet",
        clock_to_output: 0.45,
        setup: 0.40,
        lut: 0.21,
        net: 0.85,
        wide_net: 1.3,
        carry: 0.70,
        carry_bit: 0.025,
        product: (3.2, 0.03),
        lut_inputs: 6,
    },
];

/// A device name that is not known.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("--device {found}: legal is one of {legal}")]
pub struct UnknownDevice {
    /// The name given.
    pub found: String,
    /// The names there are.
    pub legal: String,
}

/// The names of all devices.
pub fn names() -> Vec<&'static str> {
    DEVICES.iter().map(|d| d.name).collect()
}

/// All devices.
pub fn all() -> &'static [Device] {
    &DEVICES
}

/// Finds a device by name.
///
/// # Errors
/// The name, with the legal ones.
pub fn find(name: &str) -> Result<&'static Device, UnknownDevice> {
    DEVICES
        .iter()
        .find(|d| d.name == name)
        .ok_or_else(|| UnknownDevice { found: name.to_owned(), legal: names().join(", ") })
}

impl Device {
    /// Arrival of a register's output after the clock edge, ns.
    pub fn launch(&self) -> f64 {
        self.clock_to_output
    }

    /// Set-up of a register, ns.
    pub fn setup(&self) -> f64 {
        self.setup
    }

    /// Delay of a carry chain of that many bits (adder, or comparator at two bits a stage), the net before it
    /// included.
    pub fn chain(&self, bits: u32) -> f64 {
        self.net + self.carry + self.carry_bit * f64::from(bits.saturating_sub(2))
    }

    /// Delay of a tree of LUTs over that many inputs.
    pub fn tree(&self, inputs: u32) -> f64 {
        let levels = f64::from(inputs.max(2)).log(f64::from(self.lut_inputs)).ceil();
        levels * (self.net + self.lut)
    }

    /// Delay of a multiplexer with that many legs, its select line with many loads.
    pub fn mux(&self, legs: usize) -> f64 {
        match legs {
            0 | 1 => 0.0,
            2 => self.wide_net + self.lut,
            n => self.wide_net + self.lut + self.tree(n as u32),
        }
    }

    /// Delay of a hardware multiplier to the top bit of a product of that many bits.
    pub fn product(&self, bits: u32) -> f64 {
        self.net + self.product.0 + self.product.1 * f64::from(bits - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn virtex_ii_figures_are_those_of_the_reports() {
        let d = find("xc2v6000-4").unwrap();
        assert!((d.product(36) - d.net - 10.356).abs() < 1e-9, "P35 after 10.356 ns");
        let adder = d.launch() + d.chain(36) + d.setup();
        assert!((5.3..5.7).contains(&adder), "a 36-bit adder between registers takes about 5.4 ns: {adder}");
    }

    #[test]
    fn an_unknown_device_names_the_known() {
        assert_eq!(find("xc7").unwrap_err().to_string(), "--device xc7: legal is one of xc2v6000-4, xc6slx150-3");
    }
}
