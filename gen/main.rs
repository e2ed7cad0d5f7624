//! The command line tool; see the library's `cli`.

use std::process::ExitCode;

/// Exit status of a process that ended by an interruption: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    if let Err(e) = ctrlc::set_handler(|| efsat::artefact::interrupted(INTERRUPTED)) {
        eprintln!("error: no handler for interruptions: {e}");
        return ExitCode::FAILURE;
    }
    efsat::cli::main()
}
