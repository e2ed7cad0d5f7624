//! The UART example on a board, for a unit or an engine whose device is on one: top, PLL, pins, and the script that makes the
//! bitstream.

use crate::artefact::VerilogFile;
use crate::artefact::files::core::Core;
use crate::artefact::files::file_lists::FileLists;
use crate::artefact::files::project::Project;
use crate::artefact::{FileSet, Prefix, origin};
use crate::design::Design;
use askama::Template;

/// A board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Board {
    /// ULX3S with an ECP5-85F, an oscillator of 25 MHz.
    Ulx3s,
    /// Arty A7-100T, an oscillator of 100 MHz.
    ArtyA7,
}

impl Board {
    /// The one that a device is on.
    fn of(device: &str) -> Option<Self> {
        match device {
            "lfe5u-85-6" => Some(Self::Ulx3s),
            "xc7a100t-1" => Some(Self::ArtyA7),
            _ => None,
        }
    }

    /// Its name in names of entities, files and folders.
    fn name(self) -> &'static str {
        match self {
            Self::Ulx3s => "ulx3s",
            Self::ArtyA7 => "arty_a7",
        }
    }
}

/// Dividers of ECP5's EHXPLLL, which compares its output, divided, with its input, divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Ehxplll {
    input: u32,
    feedback: u32,
    output: u32,
    /// Clocks of the inner oscillator by which the output's first edge is late; the feedback takes them back.
    phase: u32,
}

impl Ehxplll {
    /// The oscillator of the board.
    const MEGAHERTZ: u32 = 25;

    /// The greatest clock that is not above one of 20 to 400 MHz.
    fn new(megahertz: u32) -> Self {
        // The phase detector takes 3.125 MHz at least.
        let candidates = (1..=8).map(|input| (input, megahertz * input / Self::MEGAHERTZ));
        let (input, feedback) = candidates
            .reduce(|best, next| if next.1 * best.0 > best.1 * next.0 { next } else { best })
            .expect("there are candidates");
        // The middle of what the inner oscillator makes, 400 to 800 MHz.
        let output = 600 * input / (Self::MEGAHERTZ * feedback);
        Self { input, feedback, output, phase: (output - 1) / 2 }
    }

    fn hertz(self) -> u32 {
        (u64::from(Self::MEGAHERTZ) * 1_000_000 * u64::from(self.feedback) / u64::from(self.input)) as u32
    }
}

/// MMCME2_BASE of 7-series at 1000 MHz: eighths of the divider behind it, for the greatest clock that is not above one
/// of 20 to 400 MHz.
fn mmcm_eighths(megahertz: u32) -> u32 {
    8000_u32.div_ceil(megahertz)
}

/// A number of hertz as megahertz.
fn in_megahertz(hertz: u32) -> String {
    let text = format!("{}.{:06}", hertz / 1_000_000, hertz % 1_000_000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Files that are printed from the same values.
macro_rules! files {
    ($($file:ident = $path:literal),* $(,)?) => {$(
        #[derive(Template)]
        #[template(path = $path, escape = "none")]
        struct $file<'a>(&'a Values<'a>);

        impl<'a> std::ops::Deref for $file<'a> {
            type Target = Values<'a>;

            fn deref(&self) -> &Values<'a> {
                self.0
            }
        }
    )*};
}

files! {
    StandIn = "board/stand_in.vhd",
    Ulx3sTop = "board/ulx3s/top.vhd",
    Ulx3sClock = "board/ulx3s/clock.v",
    Ulx3sPins = "board/ulx3s/efsat.lpf",
    Ulx3sBuild = "board/ulx3s/build.sh",
    ArtyTop = "board/arty_a7/top.vhd",
    ArtyClock = "board/arty_a7/clock.vhd",
    ArtyPins = "board/arty_a7/efsat.xdc",
    ArtyProject = "board/arty_a7/project.tcl",
}

/// What the files of a board print.
struct Values<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    core: &'a Core,
    board: &'static str,
    part: String,
    hertz: u32,
    megahertz: String,
    pll: Ehxplll,
    /// The divider of the MMCM.
    divisor: String,
    /// What Vivado reads, in dependency order.
    sources: Vec<String>,
}

/// What is around the core, in Verilog, if the tools for the board read no VHDL; its sources are those behind the
/// synthesised ones. The PLL is written in Verilog, as GHDL knows no cells; in VHDL there is a stand-in.
pub fn verilog_file(design: &Design, prefix: &Prefix) -> Option<VerilogFile> {
    let board = Board::of(design.device.name).filter(|board| *board == Board::Ulx3s)?.name();
    let top = format!("{prefix}efsat_{board}");
    let file = |ending: &str| format!("{board}/{top}{ending}");
    let sources = FileLists::example(prefix).into_iter().chain([file("_stand_in.vhd"), file(".vhd")]).collect();
    Some(VerilogFile { name: file(".v"), sources, without: Some(format!("{top}_clock")), top })
}

/// Adds the board that has the device of the design, if there is one. `synthesised` are the files of the core in dependency
/// order.
pub fn add(
    set: &mut FileSet,
    core: &Core,
    design: &Design,
    prefix: &Prefix,
    synthesised: &[String],
) -> Option<Project> {
    let board = Board::of(design.device.name)?;
    let (folder, frequency) = (board.name(), design.params.frequency);
    let file = |ending: &str| format!("{folder}/{prefix}efsat_{folder}{ending}");
    let (pll, eighths) = (Ehxplll::new(frequency), mmcm_eighths(frequency));
    let hertz = match board {
        Board::Ulx3s => pll.hertz(),
        Board::ArtyA7 => (8_000_000_000 / u64::from(eighths)) as u32,
    };
    let own = [file("_clock.vhd"), file(".vhd")];
    let part = design.device.part;
    let values = &Values {
        header: &origin(),
        prefix,
        core,
        board: folder,
        part: format!("{}{}{}", part.device, part.package, part.speed),
        hertz,
        megahertz: in_megahertz(hertz),
        pll,
        divisor: format!("{}.{:03}", eighths / 8, eighths % 8 * 125),
        sources: synthesised.iter().cloned().chain(FileLists::example(prefix)).chain(own).collect(),
    };
    let texts = match board {
        Board::Ulx3s => vec![
            (file(".vhd"), Ulx3sTop(values).render()),
            (file("_clock.v"), Ulx3sClock(values).render()),
            (file(".lpf"), Ulx3sPins(values).render()),
            (format!("{folder}/build.sh"), Ulx3sBuild(values).render()),
        ],
        Board::ArtyA7 => vec![
            (file(".vhd"), ArtyTop(values).render()),
            (file("_clock.vhd"), ArtyClock(values).render()),
            (file(".xdc"), ArtyPins(values).render()),
            (format!("{folder}/project.tcl"), ArtyProject(values).render()),
        ],
    };
    for (name, text) in texts.into_iter().chain([(file("_stand_in.vhd"), StandIn(values).render())]) {
        set.insert(name, text.expect("the template renders"));
    }
    let (tool, part, how) = match board {
        Board::Ulx3s => (
            "the board ULX3S, by Yosys, nextpnr and ecppack",
            "LFE5U-85F-6BG381C".to_owned(),
            "`sh build.sh` makes the bitstream of the UART example; it needs a design that was generated with `--verilog`",
        ),
        Board::ArtyA7 => (
            "the board Arty A7-100T, by Vivado",
            values.part.clone(),
            "`vivado -mode batch -source project.tcl` makes the bitstream of the UART example",
        ),
    };
    Some(Project { folder: folder.to_owned(), tool, part, how: how.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plls_make_the_greatest_clock_that_is_not_above_the_target() {
        for target in 20..=250 {
            let pll = Ehxplll::new(target);
            let (clock, limit) = (f64::from(pll.hertz()) / 1e6, f64::from(target));
            assert!((limit - 3.125..=limit).contains(&clock), "{target}: {clock}");
            let inner = clock * f64::from(pll.output);
            assert!((400.0..=800.0).contains(&inner) && pll.feedback <= 80, "{target}: {pll:?}");
            // No other pair of dividers comes closer.
            for input in 1..=8 {
                let other = 25.0 * f64::from(target * input / 25) / f64::from(input);
                assert!(other <= clock + 1e-6, "{target}: {other}");
            }
            let clock = 8000.0 / f64::from(mmcm_eighths(target));
            let next = 8000.0 / f64::from(mmcm_eighths(target) - 1);
            assert!(clock <= limit && next > limit && (16..=1024).contains(&mmcm_eighths(target)), "{target}: {clock}");
        }
        // What the ecppll of Project Trellis takes, but for the phase where it divides by an even number.
        let dividers = |target| {
            let Ehxplll { input, feedback, output, .. } = Ehxplll::new(target);
            (input, feedback, output)
        };
        let expected = [(1, 1, 24), (1, 2, 12), (5, 12, 10), (1, 3, 8), (5, 16, 7), (1, 4, 6), (1, 8, 3)];
        assert_eq!([25, 50, 60, 75, 80, 100, 200].map(dividers), expected);
    }

    #[test]
    fn clocks_are_written_without_zeros_behind() {
        assert_eq!([50_000_000, 96_875_000, 33_333_333].map(in_megahertz), ["50", "96.875", "33.333333"]);
    }
}
