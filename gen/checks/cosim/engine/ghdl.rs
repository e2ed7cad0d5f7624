//! The printed engine under its printed testbench in GHDL.

use super::super::CosimError;
use super::super::external::{self, call, file_error};
use super::{Channel, Packet, failed};
use efsat_engine::artefact::vectors::formats_line;
use efsat_engine::artefact::{EngineDesign, TESTBENCH, bench, engine_files};
use efsat_engine::params::Memory;
use efsat_hardware::tools::Tool;
use efsat_unit::artefact::{Prefix, Scratch};
use std::fmt::Write;
use std::path::Path;

/// Seeds of the testbench.
const SEEDS: u32 = 0xffff;

/// Writes sources and testbench, and makes them ready to run.
pub(super) fn build(design: &EngineDesign, command: &Tool, dir: &Path) -> Result<(), CosimError> {
    let prefix = Prefix::default();
    let mut files = engine_files(design, &prefix, &design.command_line())?;
    files.push((format!("{TESTBENCH}.vhd"), bench(design, &prefix)));
    files.iter().try_for_each(|(name, text)| external::write_file(dir, name, text))?;
    let names: Vec<String> = files.into_iter().map(|(name, _)| name).collect();
    external::build(command, &names, TESTBENCH)
        .iter()
        .try_for_each(|args| call(dir, &command.path, args, true).map(drop))
}

/// Sends packets one behind the other; the answers, in order.
pub(super) fn exchange(
    design: &EngineDesign,
    command: &Tool,
    dir: &Path,
    memory: &[u64],
    packets: &[Vec<u64>],
    channel: &Channel,
) -> Result<Vec<Packet>, CosimError> {
    let io = Scratch::new().map_err(file_error(&std::env::temp_dir()))?;
    let [vectors, answers] = ["packets.vec", "answers.txt"].map(|name| io.path().join(name));
    let axi = design.params.memory == Memory::Axi;
    let mut text = format!("{}\n", formats_line(design));
    for (address, word) in memory.iter().enumerate().filter(|_| axi) {
        let _ = writeln!(text, "M {address:08x} {word:016x}");
    }
    for packet in packets {
        for (i, word) in packet.iter().enumerate() {
            let _ = writeln!(text, "I {word:016x} {} 1", u8::from(i + 1 == packet.len()));
        }
    }
    std::fs::write(&vectors, text).map_err(file_error(&vectors))?;
    // The first pass is at full speed, others have gaps.
    let pass = if channel.gaps { 2 } else { 1 };
    let mut options = vec![
        format!("vectors={}", vectors.display()),
        format!("answers={}", answers.display()),
        "compared=false".to_owned(),
        format!("patience={}", channel.patience),
        format!("seed={}", 1 + channel.seed % SEEDS),
        format!("first_pass={pass}"),
        format!("passes={pass}"),
    ];
    if axi {
        options.push(format!("latency_least={}", channel.latency.start()));
        options.push(format!("latency_most={}", channel.latency.end()));
    }
    let args = external::simulate(command, TESTBENCH, options.iter().map(|option| format!("-g{option}")));
    let said = call(dir, &command.path, &args, false)?;
    if !said.contains(" mismatches 0 ") {
        let complaint = said.lines().find(|line| line.contains(TESTBENCH)).or(said.lines().last());
        return Err(failed(complaint.unwrap_or("the testbench said nothing")));
    }
    let text = std::fs::read_to_string(&answers).map_err(file_error(&answers))?;
    let (mut read, mut words) = (vec![], vec![]);
    for line in text.lines() {
        let mut fields = line.split(' ');
        let mut field = || fields.next().ok_or_else(|| failed(line));
        words.push(u64::from_str_radix(field()?, 16).map_err(|_| failed(line))?);
        let last = field()? == "1";
        let clock = field()?.parse().map_err(|_| failed(line))?;
        if last {
            read.push(Packet { words: std::mem::take(&mut words), clock });
        }
    }
    Ok(read)
}
