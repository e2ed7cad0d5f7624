//! Each pass from graph to VHDL on designs of a few lines, with the text that it makes of them.
//!
//! A file is a pass. What a pass makes is compared with the text in the test; `UPDATE_EXPECT=1 cargo test -p efsat-hardware
//! --test passes` writes the present text there, for the diff to be read. `random` runs whole random designs through all passes.

mod chain;
mod control;
mod divide;
mod evaluate;
mod flat;
mod graph;
mod lower;
mod names;
mod phases;
mod prune;
mod random;
mod schedule;
mod sections;
mod simulate;
mod vhdl;

use efsat_hardware::device::{self, Device};
use efsat_hardware::graph::{Block, Library, Sig, Top};
use efsat_hardware::netlist::lower::{Lowering, Probe};
use efsat_hardware::netlist::{Control, Module};
use efsat_hardware::op::{Range, Type};
use efsat_hardware::schedule::{Schedule, Scheduler};
use expect_test::Expect;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

/// Eight bits with four of fraction.
const S8: Type = Type::signed(8, 4);
const ALL: Range = S8.limits();

fn part(name: &str) -> &'static Device {
    device::find(name).expect("a known device")
}

/// A block at the top whose outputs are what `body` makes.
fn block(interval: usize, body: impl for<'l> FnOnce(Top<'l>) -> Vec<Sig<'l>>) -> Rc<Block> {
    Library::default().block("sample", &[], interval, body)
}

/// On a Virtex-II.
fn scheduled(block: &Rc<Block>, megahertz: u32) -> Rc<Schedule> {
    scheduled_for("xc2v6000-4", block, megahertz)
}

fn scheduled_for(device: &str, block: &Rc<Block>, megahertz: u32) -> Rc<Schedule> {
    Scheduler::new(part(device), megahertz).schedule(block)
}

fn lowered_for(device: &str, block: &Rc<Block>, megahertz: u32) -> (Rc<Module>, Vec<Probe>) {
    let device = part(device);
    Lowering::new(&mut Scheduler::new(device, megahertz), device).lower(block, true)
}

fn lowered(block: &Rc<Block>, megahertz: u32) -> Rc<Module> {
    lowered_for("xc2v6000-4", block, megahertz).0
}

fn module(body: impl FnOnce(&Control)) -> Rc<Module> {
    let control = Control::new("sample", vec![]);
    body(&control);
    control.finish()
}

/// What is said where something is refused.
fn refusal<R>(f: impl FnOnce() -> R) -> String {
    match catch_unwind(AssertUnwindSafe(f)) {
        Ok(_) => "not refused".to_owned(),
        Err(why) => why.downcast_ref::<String>().cloned().unwrap_or_else(|| "another panic".to_owned()),
    }
}

/// Compares lines, with a line feed behind the last.
fn lines(expected: Expect, found: impl IntoIterator<Item = String>) {
    expected.assert_eq(&found.into_iter().map(|line| line + "\n").collect::<String>());
}
