//! The command line tool; its commands are in the crate `efsat-cli`.

use std::process::ExitCode;

/// Exit status of a process that ended by an interruption: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    let handler = || {
        let _stopped = efsat_checks::process::stop();
        efsat_cli::interrupted();
        efsat::artefact::interrupted(INTERRUPTED)
    };
    match ctrlc::set_handler(handler) {
        Ok(()) => efsat_cli::main(),
        Err(e) => efsat_cli::report(&format!("no handler for interruptions: {e}"), 1),
    }
}
