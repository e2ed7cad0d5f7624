//! Device models: what an operation of a given width takes on a target part, in nanoseconds and in parts.
//!
//! One file a family; each says where its figures come from and which of them are not known (docs/devices.md says the
//! same to readers). Delays serve the scheduler, which counts in nets, look-up tables, carry chains and multipliers;
//! the [`Fabric`] serves predictions of parts.

mod block_ram;
mod ecp5;
mod fabric;
mod nexus;
mod own;
pub mod resources;
mod series7;
mod spartan6;
mod ultrascale_plus;
// For the static timing of the checks.
#[doc(hidden)]
pub mod virtex2;

pub use block_ram::block_rams;
// For the estimates: what a family makes of gates.
#[doc(hidden)]
pub use fabric::{Chains, Fabric, MultiplierRegisters};
pub use resources::Resources;

/// A target part.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Name on the command line.
    pub name: &'static str,
    /// Family.
    pub family: Family,
    /// What project files call it.
    pub part: Part,
    /// What there is on the part.
    pub capacity: Resources,
    /// Hardware multipliers on the part.
    pub multipliers: u32,
    /// Block RAMs on the part, in units of 18 kbit.
    pub block_rams: u32,
    /// Where the delays come from.
    pub source: &'static str,
    /// Bits of the signed operands of a hardware multiplier, the wider first.
    pub multiplier: [u32; 2],
    /// Bits of the adder behind a multiplier, through which multipliers make chains; 0 where there is none, or none is used.
    pub adder: u32,
    /// How logic is mapped to it.
    pub fabric: &'static Fabric,
    /// Clock to output of a flip-flop.
    clock_to_output: f64,
    /// Clock to output of the register behind a product, and by how much the net behind it takes longer than others:
    /// multipliers lie in columns of their own.
    product_to_output: f64,
    /// Clock to output of a look-up table that is a shift register with a tap, where reports tell it.
    tapped_line: Option<f64>,
    /// Set-up of a flip-flop.
    setup: f64,
    /// One LUT.
    lut: f64,
    /// What a choice among many legs is made of, where reports say so; without it counts as a tree over its legs.
    wide_choice: Option<WideChoice>,
    /// A net with few loads.
    net: f64,
    /// A net with many loads (select lines).
    wide_net: f64,
    /// Entering and leaving a carry chain, LUT included.
    carry: f64,
    /// One bit of carry.
    carry_bit: f64,
    /// By how much nets to multipliers take longer than others in large designs, ns, where reports say so.
    far_multipliers: Option<f64>,
    /// A product's bit k: base + k * step.
    product: (f64, f64),
    /// How much of that is behind the multiplier's own register. Where no report tells it, the middle of what serves: the
    /// schedule holds for other divisions too, as long as both sides fit in a period.
    product_behind_register: f64,
}

/// A choice among more than two legs. If one wide table takes them all it is that table; else there are levels of tables,
/// the last of them wide, behind one that decodes the index.
#[derive(Clone, Copy, Debug, PartialEq)]
struct WideChoice {
    /// Legs that a wide table takes, and by which each level divides them.
    legs: u32,
    /// Delay of the slice's multiplexers, which make a wide table of others, ns. What comes out of them reaches a flip-flop
    /// by a net.
    multiplexers: f64,
}

/// Families, by the tools that serve them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// Virtex-II: ISE up to 10.1.
    Virtex2,
    /// Spartan-6: ISE up to 14.7.
    Spartan6,
    /// 7-series: Vivado.
    Series7,
    /// UltraScale+: Vivado.
    UltraScalePlus,
    /// ECP5: nextpnr, Diamond.
    Ecp5,
    /// Nexus (CrossLink-NX): nextpnr, Radiant.
    Nexus,
}

/// Names of a part in vendor project files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Family.
    pub family: &'static str,
    /// Device.
    pub device: &'static str,
    /// Package.
    pub package: &'static str,
    /// Speed grade, with its dash.
    pub speed: &'static str,
}

/// A multiplier of every part takes signed operands of at least this many bits.
pub const MULTIPLIER_BITS: u32 = 18;

/// Bits of the shortest product that is worth a multiplier; look-up tables make shorter ones.
pub const SHORTEST_PRODUCT: u32 = 9;

const DEVICES: [Device; 8] = [
    virtex2::XC2V6000,
    spartan6::XC6SLX150,
    series7::XC7A200T,
    ecp5::LFE5U_85,
    series7::XC7A100T,
    series7::XC7Z020,
    ultrascale_plus::XCZU3EG,
    nexus::LIFCL_40,
];

/// What is behind the name of a file of one's own.
// For the command line.
#[doc(hidden)]
pub const OWN: &str = ".toml";

/// A device that is not there: a name that is not known, or a file that cannot be taken.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("--device {found}: {why}")]
pub struct DeviceError {
    /// The name given.
    pub found: String,
    /// Where in the file and what, and what was expected.
    pub why: String,
}

/// The names of all devices.
pub fn names() -> Vec<&'static str> {
    DEVICES.iter().map(|d| d.name).collect()
}

/// All devices.
pub fn all() -> &'static [Device] {
    &DEVICES
}

/// Finds a device by name, or reads the file of one's own with this name, which ends in `.toml`.
///
/// # Errors
/// The name, with the legal ones; what is wrong with the file.
pub fn find(name: &str) -> Result<&'static Device, DeviceError> {
    if name.ends_with(OWN) {
        return own::read(name);
    }
    known(name).map_err(|e| DeviceError { why: format!("{}, or a file NAME.toml of your own", e.why), ..e })
}

fn known(name: &str) -> Result<&'static Device, DeviceError> {
    DEVICES
        .iter()
        .find(|d| d.name == name)
        .ok_or_else(|| DeviceError { found: name.to_owned(), why: format!("expected one of {}", names().join(", ")) })
}

impl Device {
    /// The delays that pages list, ns, each with what a bit more adds: clock to output, set-up, LUT, net, net with many loads,
    /// carry chain of two bits, product, register behind a product with what its net takes more.
    pub fn delays(&self) -> [(f64, f64); 8] {
        let alone = |ns| (ns, 0.0);
        let [launch, setup, lut] = [self.clock_to_output, self.setup, self.lut].map(alone);
        let [net, wide_net, behind] = [self.net, self.wide_net, self.product_to_output].map(alone);
        [launch, setup, lut, net, wide_net, (self.carry, self.carry_bit), self.product, behind]
    }

    /// Arrival of a register's output after the clock edge, ns.
    pub fn launch(&self) -> f64 {
        self.clock_to_output
    }

    /// Arrival of a product from the multiplier's register, ns, counted as if the net behind it were any other.
    pub fn product_launch(&self) -> f64 {
        self.product_to_output + self.product_behind_register
    }

    /// Arrival of a sum from the register of the adder behind a multiplier, ns.
    // For the scheduler.
    #[doc(hidden)]
    pub fn sum_launch(&self) -> f64 {
        self.product_to_output
    }

    /// Arrival of what comes out of a delay line with a tap after the clock edge, ns; none where designs for the device have
    /// no such lines.
    pub fn tapped_line(&self) -> Option<f64> {
        self.tapped_line
    }

    /// Set-up of a register, ns.
    pub fn setup(&self) -> f64 {
        self.setup
    }

    /// The clock in MHz that a path of so many ns between registers allows.
    pub fn megahertz(&self, ns: f64) -> f64 {
        1000.0 / (ns + self.setup)
    }

    /// Delay of a carry chain of that many bits, the net before it included.
    pub fn chain(&self, bits: u32) -> f64 {
        self.net + self.carry + self.carry_bit * f64::from(bits.saturating_sub(2))
    }

    /// Delay of a test whether two words are equal: a carry chain with two bits a stage; a tree of tables where the chain is
    /// [`Chains::Complete`].
    pub fn equality(&self, bits: u32) -> f64 {
        match self.fabric.chains {
            Chains::WithTables => self.chain(bits.div_ceil(2)),
            Chains::Complete => self.tree(2 * bits),
        }
    }

    /// Delay of a negation under a flag, which is a net with many loads: a chain, and a LUT of its own in front of a
    /// complete one.
    pub fn conditional_negation(&self, bits: u32) -> f64 {
        match self.fabric.chains {
            Chains::WithTables => self.chain(bits) - self.net + self.wide_net,
            Chains::Complete => self.mux(2) + self.chain(bits),
        }
    }

    /// Delay of a tree of LUTs over that many inputs.
    pub fn tree(&self, inputs: u32) -> f64 {
        self.levels(inputs, self.fabric.lut_inputs() as u32)
    }

    /// Delay of levels of LUTs, each of which leaves one signal of that many.
    fn levels(&self, inputs: u32, each: u32) -> f64 {
        let levels = f64::from(inputs.max(2)).log(f64::from(each)).ceil();
        levels * (self.net + self.lut)
    }

    /// Delay of a multiplexer with that many legs, its select line with many loads.
    pub fn mux(&self, legs: usize) -> f64 {
        match legs {
            0 | 1 => 0.0,
            2 => self.wide_net + self.lut,
            n => {
                let legs = match self.wide_choice {
                    Some(choice) if n as u32 <= choice.legs => choice.multiplexers + self.net,
                    Some(choice) => self.levels(n as u32, choice.legs) + choice.multiplexers + self.net,
                    None => self.tree(n as u32),
                };
                self.wide_net + self.lut + legs
            }
        }
    }

    /// Delay of a hardware multiplier to its register, for the top bit of a product of that many bits.
    pub fn product(&self, bits: u32) -> f64 {
        self.net + self.inner_product(bits)
    }

    /// The same from registers of the operands that are the multiplier's own.
    fn inner_product(&self, bits: u32) -> f64 {
        self.product.0 + self.product.1 * f64::from(bits - 1) - self.product_behind_register
    }

    /// Whether the operands of a product get registers of their own, because a period (less the set-up of a register) does not
    /// hold the nets to multipliers as well.
    pub fn registers_operands(&self, bits: u32, period: f64) -> bool {
        // A register of the multiplier's own needs no net; another one is on the way to it.
        let net = self.far_multipliers.or(self.multiplier_has_operand_registers().then_some(0.0));
        net.is_some_and(|net| self.launch() + net + self.product(bits) > period)
    }

    fn multiplier_has_operand_registers(&self) -> bool {
        self.fabric.multiplier_registers == MultiplierRegisters::OperandsAndProduct
    }

    /// Arrival of a product at its register in such a period, from the registers in front of it.
    // For the scheduler.
    #[doc(hidden)]
    pub fn product_arrival(&self, bits: u32, period: f64) -> f64 {
        let inner = self.multiplier_has_operand_registers() && self.registers_operands(bits, period);
        self.launch() + if inner { self.inner_product(bits) } else { self.product(bits) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn virtex_ii_figures_are_those_of_the_reports() {
        let d = find("xc2v6000-4").unwrap();
        assert!((d.product(36) + d.product_behind_register - d.net - 10.356).abs() < 1e-9, "P35 after 10.356 ns");
        let adder = d.launch() + d.chain(36) + d.setup();
        assert!((5.3..5.7).contains(&adder), "a 36-bit adder between registers takes about 5.4 ns: {adder}");
    }

    #[test]
    fn an_unknown_device_names_the_known() {
        assert_eq!(
            find("xc7").unwrap_err().to_string(),
            "--device xc7: expected one of xc2v6000-4, xc6slx150-3, xc7a200t-1, lfe5u-85-6, xc7a100t-1, xc7z020-1, xczu3eg-1, \
             lifcl-40-9, or a file NAME.toml of your own"
        );
    }
}
