//! Programs that are run: each in a process group of its own, with all that it starts, so that an interruption can stop
//! it, whoever was meant by the signal.

use rustix::process::{Pid, Signal, kill_process_group};
use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdout, Command, ExitStatus, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use wait_timeout::ChildExt;

/// Longer than any program runs.
pub(crate) const FOREVER: Duration = Duration::from_secs(100 * 24 * 3600);

/// The groups there are now, by their first process.
static RUNNING: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

fn running() -> MutexGuard<'static, Vec<Pid>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A program that runs; stopped with all that it has started when it goes out of scope, and by [`stop`].
pub(crate) struct Running {
    group: Pid,
    /// None once it is known to have ended.
    child: Option<Child>,
}

impl Running {
    /// Starts a program.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        let mut running = running();
        let child = command.process_group(0).spawn()?;
        let group = Pid::from_child(&child);
        running.push(group);
        Ok(Self { group, child: Some(child) })
    }

    /// Its standard output, if that is a pipe; once.
    pub fn stdout(&mut self) -> Option<ChildStdout> {
        self.child.as_mut()?.stdout.take()
    }

    /// Waits until it ends; it is stopped after `limit`, and there is no status.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn wait(mut self, limit: Duration) -> io::Result<Option<ExitStatus>> {
        let status = self.child.as_mut().map(|child| child.wait_timeout(limit)).transpose()?.flatten();
        if status.is_some() {
            self.child = None;
        }
        Ok(status)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            // It may have ended meanwhile, and there is no one to tell if not.
            let _ = kill_process_group(self.group, Signal::KILL);
            let _ = child.wait();
        }
        running().retain(|group| *group != self.group);
    }
}

/// Runs a program to its end; what it printed.
pub(crate) fn output(command: &mut Command) -> io::Result<Output> {
    let mut running = Running::start(command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()))?;
    match running.child.take() {
        Some(child) => child.wait_with_output(),
        None => unreachable!("it has just been started"),
    }
}

/// For the handler of an interruption: stops all programs. No other starts, and nobody learns that one has ended, as long
/// as the result is there.
pub fn stop() -> impl Sized {
    let running = running();
    for group in running.iter() {
        // It may have ended by itself.
        let _ = kill_process_group(*group, Signal::KILL);
    }
    running
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    /// A shell whose child has the other end of the pipe, too.
    fn shell(script: &str) -> Running {
        Running::start(Command::new("/bin/sh").args(["-c", script]).stdout(Stdio::piped())).unwrap()
    }

    #[test]
    fn what_a_program_has_started_ends_with_it() {
        let mut program = shell("sleep 60 & echo; wait");
        let mut pipe = program.stdout().unwrap();
        pipe.read_exact(&mut [0]).unwrap();
        let group = program.group;
        assert!(running().contains(&group));
        assert!(program.wait(Duration::ZERO).unwrap().is_none());
        assert!(!running().contains(&group));
        // Nobody is there to write any more.
        assert_eq!(pipe.read_to_end(&mut vec![]).unwrap(), 0);
    }

    #[test]
    fn a_program_that_ends_is_not_stopped() {
        let status = shell("exit 3").wait(Duration::from_secs(60)).unwrap();
        assert_eq!(status.and_then(|status| status.code()), Some(3));
        let output = output(Command::new("/bin/sh").args(["-c", "echo out; echo err >&2; cat"])).unwrap();
        assert_eq!((output.stdout.as_slice(), output.stderr.as_slice()), (&b"out\n"[..], &b"err\n"[..]));
        assert!(output.status.success());
    }
}
