//! Why a command ends without success.

use clap::error::{ContextKind, ErrorKind};
use efsat_checks::cosim::CosimError;
use efsat_checks::journal::JournalError;
use efsat_checks::synth::SynthError;
use efsat_engine::driver::{EngineError, ObjectsError};
use efsat_geometry::pair_file::PairFileError;
use efsat_geometry::scene::SceneError;
use efsat_studies::planner::TooMany;
use efsat_unit::artefact::FileSetError;
use efsat_unit::design::top::DesignError;

/// Why a command ends early or without success.
#[derive(Debug)]
pub(super) enum Failure {
    /// A check failed: exit status 1.
    Check(String),
    /// The command line or an input file is wrong, or an output cannot be written: exit status 2.
    Usage(String),
    /// Standard output was closed by its reader.
    Closed,
}

impl Failure {
    /// What is said; nothing if nobody listens.
    pub fn message(self) -> String {
        match self {
            Self::Check(message) | Self::Usage(message) => message,
            Self::Closed => String::new(),
        }
    }
}

/// Errors that always mean a wrong command line, input or output.
macro_rules! usage {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(e: $error) -> Self {
                Self::Usage(e.to_string())
            }
        })*
    };
}

usage!(DesignError, FileSetError, JournalError, PairFileError, SceneError, TooMany);

impl From<CosimError> for Failure {
    fn from(e: CosimError) -> Self {
        match e {
            CosimError::Design(e) => e.into(),
            e if e.is_usage() => Self::Usage(e.to_string()),
            e => Self::Check(e.to_string()),
        }
    }
}

impl From<EngineError> for Failure {
    fn from(e: EngineError) -> Self {
        Self::Check(e.to_string())
    }
}

impl From<ObjectsError> for Failure {
    fn from(e: ObjectsError) -> Self {
        match e {
            ObjectsError::Parameter(e) => DesignError::from(e).into(),
            ObjectsError::Build(e) => Self::Usage(e.to_string()),
        }
    }
}

impl From<SynthError> for Failure {
    fn from(e: SynthError) -> Self {
        match e {
            SynthError::Design(e) => e.into(),
            e if e.is_usage() => Self::Usage(e.to_string()),
            e => Self::Check(e.to_string()),
        }
    }
}

/// What clap says, on one line: without its usage and its hint at `--help`.
pub(super) fn from_clap(e: &clap::Error, commands: &[String]) -> Failure {
    if e.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return Failure::Usage(format!("no command: expected one of {}", commands.join(", ")));
    }
    let text = e.render().to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let told = |line: &&str| !line.is_empty() && !line.starts_with("For more information");
    let lines = text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:")).filter(told);
    let mut message = String::new();
    for line in lines {
        let values = line.strip_prefix("[possible values: ").and_then(|rest| rest.strip_suffix(']'));
        match (values, message.is_empty()) {
            (Some(values), _) => message.push_str(&format!(": expected one of {values}")),
            (None, true) => message.push_str(line),
            (None, false) if message.ends_with(':') => message.push_str(&format!(" {line}")),
            (None, false) => message.push_str(&format!("; {line}")),
        }
    }
    let invalid = |kind| e.get(kind).map(ToString::to_string).unwrap_or_default();
    match e.kind() {
        ErrorKind::InvalidValue if invalid(ContextKind::InvalidArg).starts_with("--device ") => {
            message.push_str(&of_family(&invalid(ContextKind::InvalidValue)));
        }
        ErrorKind::UnknownArgument => message.push_str("; --help lists the options"),
        ErrorKind::InvalidSubcommand => {
            // Only where the commands of the program itself are expected.
            if text.contains("'soak'") && commands.iter().any(|command| command == "stress") {
                message.push_str("; it is stress --once now");
            }
            message.push_str(&format!("; expected one of {}", commands.join(", ")));
        }
        _ => {}
    }
    Failure::Usage(message)
}

/// Words that name a family, and one of its devices.
const FAMILIES: [(&[&str], &str, &str); 6] = [
    (&["xczu", "xck", "xcku", "xcvu", "ultrascale", "kria"], "UltraScale+", "xczu3eg-1"),
    (&["xc7", "artix", "kintex", "zynq", "spartan7"], "the 7 series", "xc7a100t-1"),
    (&["xc6", "spartan6"], "Spartan-6", "xc6slx150-3"),
    (&["xc2v", "virtex2"], "Virtex-II", "xc2v6000-4"),
    (&["lfe5", "ecp5"], "the ECP5", "lfe5u-85-6"),
    (&["lifcl", "lfd2nx", "lfcpnx", "nexus", "crosslinknx", "certus"], "Nexus", "lifcl-40-9"),
];

/// What to take for a device that is not known.
fn of_family(device: &str) -> String {
    let name: String = device.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
    let known = FAMILIES.iter().find(|(words, ..)| words.iter().any(|word| name.starts_with(word)));
    known.map_or(String::new(), |(_, family, like)| format!("; for another device of {family} take {like}"))
        + ", or a file NAME.toml of your own"
}
