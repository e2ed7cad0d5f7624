//! What a core around the unit shares with it, as the collision engine does: the parts of both, and no more. Whoever uses the
//! unit alone needs none of them.

// Options of a command line.
pub use crate::params::options::Spelled;
#[cfg(feature = "clap")]
pub use crate::params::options::{choice, one_of, whole};

// Units and control of a design.
pub use crate::design::determinants::shared;
pub use crate::design::guard::any;
pub use crate::design::product::product;
pub use crate::design::sequencer::output;
pub use crate::design::slots::Slots;

// Constants for users, and their side in C and Python.
pub use crate::artefact::wrap::host::{HostSide, RETEST, constants_package, retest};

// Files: bits of words, the example behind a UART, boards, lists, Verilog, and the manifest.
pub use crate::artefact::bits::Bits;
pub use crate::artefact::files::core::{Core, FileRow};
pub use crate::artefact::files::project::Project;
pub use crate::artefact::wrap::drop_in::named;
pub use crate::artefact::wrap::example::add_top;
pub use crate::artefact::wrap::packaged::Packaged;
pub use crate::artefact::wrap::projects::add as add_projects;
pub use crate::artefact::wrap::verilog::verilog_of;

// Words of the stream: vectors, and packets.
pub use crate::artefact::check::stream_vectors::Maker;
pub use crate::host::driver::packet;

/// The files of boards.
pub mod board {
    pub use crate::artefact::wrap::board::{add, verilog_file};
}

/// Registers around a core, and the file of their testbench.
pub mod registers {
    pub use crate::artefact::check::register_script::{Script, hash};
    pub use crate::artefact::wrap::registers::{Shell, refusal_table, table};
    pub use crate::words::registers::{Behind, Field, PLACES, Register, registers};
}

/// What every manifest has.
pub mod manifest {
    pub use crate::artefact::files::manifest::{NAME, digests, files, generator, of};
}

use crate::params::options::Choice;
use efsat_geometry::directions::Directions;

impl Choice for Directions {
    const ALL: &'static [Self] = &Self::ALL;

    fn name(self) -> &'static str {
        match self {
            Self::Six => "6",
            Self::Fourteen => "14",
            Self::Eighteen => "18",
            Self::TwentySix => "26",
        }
    }
}
