//! The generated files in projects of others: names that do not meet those of other designs.

mod board;
mod host;

use crate::extent::{in_full, share};
use crate::tools::program::{efsat, refuses, succeeds};
use crate::tools::{Ghdl, ghdl, has};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// The files of a list of a design, by their names above its folder.
fn listed(ghdl: &Ghdl, design: &str, list: &str) -> Vec<String> {
    ghdl.read(&format!("{design}/{list}")).lines().map(|file| format!("{design}/{file}")).collect()
}

/// Small designs of two methods.
const SMALL: [(&str, &str); 2] = [
    ("near", "--width 8 --transform-width 10"),
    ("far", "--method determinants --width 7 --transform-width 9 --clocks-per-pair 6"),
];

/// Entities that a user may have.
const OF_THE_USER: &str = "\
entity projection is end entity projection;
architecture mine of projection is begin end architecture mine;
entity cross_product is end entity cross_product;
architecture mine of cross_product is begin end architecture mine;
entity efsat is end entity efsat;
architecture mine of efsat is begin
  a : entity work.projection;
  b : entity work.cross_product;
end architecture mine;
";

#[test]
fn two_named_designs_and_those_of_the_user_share_a_library() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    for (name, options) in SMALL {
        succeeds(dir, &format!("generate --name {name} --out {name} {options}"));
        let list = std::fs::read_to_string(dir.join(name).join("files.txt")).unwrap();
        for file in list.lines() {
            let stem = file.rsplit('/').next().unwrap();
            assert!(stem.starts_with(&format!("{name}_")), "{file}");
        }
        let said = std::fs::read_to_string(dir.join(name).join("README.md")).unwrap();
        for expected in ["`NAME_efsat.vhd`", "`NAME_efsat_tb`", "efsat:core:NAME_efsat", "| `NAME_pair_pipeline` |"] {
            let expected = expected.replace("NAME", name);
            assert!(said.contains(&expected), "{name}: {expected}");
        }
        succeeds(dir, &format!("generate --check --name {name} --out {name} {options}"));
    }
    let Some(tool) = ghdl() else { return };
    let ghdl = Ghdl::at(tool, dir);
    for (name, _) in SMALL {
        ghdl.analyse(&listed(&ghdl, name, "files.txt"));
    }
    ghdl.write("user.vhd", OF_THE_USER);
    ghdl.analyse(&["user.vhd"]);
    ghdl.elaborate("efsat");
    // All three are in the library now, and both designs still answer as they should.
    for (name, _) in SMALL {
        for bench in share(2, ["efsat_tb", "efsat_stream_tb"]) {
            let entity = format!("{name}_{bench}");
            let (fine, said) = ghdl.run(&entity, &[&format!("-gvectors={name}/{entity}.vec")]);
            assert!(fine && said.contains(&format!("{entity}: ")) && said.contains(" mismatches 0 "), "{said}");
        }
    }
}

/// A design with the instances to copy, each with signals of its own.
pub(crate) fn pasted(instances: &str) -> String {
    let block = |(i, text): (usize, &str)| {
        let code: Vec<&str> = text.lines().skip(1).filter(|line| !line.starts_with("--")).collect();
        let is_signal = |line: &&&str| line.trim_start().starts_with("signal ");
        let signals: Vec<&str> = code.iter().filter(is_signal).copied().collect();
        let statement: Vec<&str> = code.iter().filter(|line| !is_signal(line)).copied().collect();
        format!("  part_{i} : block\n{}\n  begin\n{}\n  end block;\n", signals.join("\n"), statement.join("\n"))
    };
    let blocks: String = instances.split("-- ===== ").skip(1).enumerate().map(block).collect();
    format!(
        "library ieee;\nuse ieee.std_logic_1164.all;\nentity pasted is\nend entity pasted;\n\
         architecture rtl of pasted is\nbegin\n{blocks}end architecture rtl;\n"
    )
}

/// What is made of a unit for tools of others is made of an engine, whatever its memory: what a project names is there, its top has the
/// buses that Vivado looks for, and the instances to copy fit their entities.
#[test]
fn an_engine_has_the_projects_of_a_unit() {
    let home = tempfile::tempdir().unwrap();
    let small = "--engine --method axes --width 10 --transform-width 26";
    for (options, stem, top, buses) in [
        ("--width 8 --transform-width 10".to_owned(), "efsat", "efsat_stream", "s_axis m_axis"),
        (
            format!("{small} --memory block-ram --block-lines 256 --triangle-lines 256"),
            "efsat_engine",
            "efsat_engine",
            "s_axis m_axis",
        ),
        (
            format!("{small} --block-lines 32 --triangle-lines 16"),
            "efsat_engine",
            "efsat_engine",
            "s_axis m_axi m_axis",
        ),
        (
            format!("{small} --block-lines 32 --triangle-lines 16 --registers"),
            "efsat_engine",
            "efsat_shell",
            "s_axi m_axi irq",
        ),
    ] {
        for (device, project) in [("xc2v6000-4", "ise"), ("xc7a200t-1", "vivado")] {
            let dir = &home.path().join(device);
            succeeds(home.path(), &format!("generate --out {device} --device {device} {options}"));
            let read = |name: &str| std::fs::read_to_string(dir.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
            let core = read(&format!("{stem}.core"));
            let named = core.lines().filter_map(|line| line.trim().strip_prefix("- ")?.split(':').next());
            assert!(named.clone().count() > 20 && core.contains(&format!("toplevel: {top}\n")), "{core}");
            let script = read(&format!("{project}/project.tcl"));
            for name in named {
                assert!(dir.join(name).is_file(), "{name}");
                assert!(
                    name.contains("_tb") || name.contains("example/") || script.contains(name),
                    "{project}: {name}"
                );
            }
            for name in ["vunit/run.py", &format!("cocotb/test_{stem}.py"), &format!("{stem}.sdc")] {
                assert!(
                    read("README.md").contains(name.split('/').next().unwrap()) && !read(name).is_empty(),
                    "{name}"
                );
            }
            if project == "ise" {
                // What the command line and the project say of registers.
                assert!(read(&format!("ise/{stem}.xst")).contains("\n-register_balancing No\n"));
                assert!(
                    script.contains("\"Register Balancing\" No ") && script.contains(&format!("\"rtl\" \"{top}\""))
                );
                continue;
            }
            let ip = read("vivado/package_ip.tcl");
            let found: Vec<&str> = ip
                .lines()
                .filter_map(|line| {
                    let bus = line.strip_prefix("ipx::associate_bus_interfaces -busif ");
                    bus.or_else(|| line.strip_prefix("ipx::infer_bus_interface "))?.split(' ').next()
                })
                .collect();
            assert_eq!(found.join(" "), buses, "{options}");
            assert_eq!(read(&format!("vivado/{stem}_ooc.xdc")), read(&format!("{stem}.sdc")));
            let Some(tool) = ghdl() else { continue };
            let ghdl = Ghdl::at(tool, dir);
            ghdl.analyse(&ghdl.read("files-synthesis.txt").lines().collect::<Vec<_>>());
            ghdl.write("pasted.vhd", &pasted(&read(&format!("{stem}_instance.vhd.txt"))));
            ghdl.analyse(&["pasted.vhd"]);
            ghdl.elaborate("pasted");
        }
    }
}

/// What is around the wrapper, with constants of the package alone.
const AROUND: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use work.efsat_constants.all;
entity around is end entity around;
architecture mine of around is
  signal clk, valid, last, ready, out_valid, out_last, out_ready : std_logic := '0';
  signal word : std_logic_vector(efsat_word_bits - 1 downto 0);
  signal keep : std_logic_vector(efsat_word_bits / 8 - 1 downto 0);
  signal answer : std_logic_vector(efsat_answer_word_bits - 1 downto 0);
  signal answer_keep : std_logic_vector(efsat_answer_word_bits / 8 - 1 downto 0);
  signal tag : std_logic_vector(efsat_tag_bits - 1 downto 0);
  signal separated, overlapping : std_logic_vector(efsat_flag_bits - 1 downto 0);
begin
  unit : entity work.efsat_stream
    port map (aclk => clk, aresetn => clk, s_axis_tdata => word, s_axis_tkeep => keep, s_axis_tvalid => valid,
      s_axis_tlast => last, s_axis_tready => ready, m_axis_tdata => answer, m_axis_tkeep => answer_keep,
      m_axis_tvalid => out_valid, m_axis_tlast => out_last, m_axis_tready => out_ready);
  tag <= answer(efsat_answer_tag_low + efsat_tag_bits - 1 downto efsat_answer_tag_low);
  separated <= answer(efsat_answer_separated_low + efsat_flag_bits - 1 downto efsat_answer_separated_low);
  overlapping <= answer(efsat_answer_overlapping_low + efsat_flag_bits - 1 downto efsat_answer_overlapping_low);
  assert efsat_record_number_low + efsat_pair_numbers * efsat_record_number_step <= efsat_pair_words * efsat_word_bits
    severity failure;
  assert efsat_pairs_header(7 downto 0) = x\"01\" severity failure;
end architecture mine;
";

#[test]
fn what_is_around_the_wrapper_is_written_with_constants() {
    let Some(tool) = ghdl() else { return };
    for options in ["", "--method determinants --stream-width 32 --tag-width 40", "--transform off --upper sticky"] {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path();
        succeeds(dir, &format!("generate --out rtl --width 8 --transform-width 10 {options}"));
        let ghdl = Ghdl::at(tool, dir);
        let mut files = listed(&ghdl, "rtl", "files-synthesis.txt");
        assert!(files.iter().all(|file| !file.contains("_tb") && !file.contains("example")), "{files:?}");
        ghdl.write("around.vhd", AROUND);
        files.push("around.vhd".to_owned());
        ghdl.analyse(&files);
        let (fine, said) = ghdl.run("around", &["--stop-time=1ns"]);
        assert!(fine, "{said}");
        // The same numbers as in the manifest.
        let manifest = std::fs::read_to_string(dir.join("rtl/manifest.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        let package = std::fs::read_to_string(dir.join("rtl/efsat_constants.vhd")).unwrap();
        for (name, value) in [
            ("latency", &manifest["latency"]),
            ("clocks_per_pair", &manifest["initiation_interval"]),
            ("pair_words", &manifest["stream"]["pair_words"]),
            ("stream_clocks_per_pair", &manifest["stream"]["clocks_per_pair"]),
        ] {
            assert!(package.contains(&format!("  constant efsat_{name} : natural := {value};")), "{name}: {package}");
        }
    }
}

#[test]
fn a_name_that_vhdl_does_not_take_is_refused() {
    let home = tempfile::tempdir().unwrap();
    for (name, why) in [
        ("signal", "'signal' is a keyword of VHDL-87"),
        ("1st", "'1st' does not begin with a lower-case letter"),
        ("Left", "'Left' does not begin with a lower-case letter"),
        ("a__b", "'a__b' has a trailing or double underscore"),
    ] {
        let said = efsat(&home, &format!("generate --out x --name {name}")).2;
        assert!(said.contains("'--name <NAME>'") && said.contains(why), "{said}");
        refuses(&home, &format!("generate --out x --name {name}"), "expected a VHDL identifier of at most 40 ");
    }
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
}

/// A file of vectors with a bit of its first answer changed. `V` is followed by a pair and its answer, `O` by an answer.
fn with_a_wrong_answer(vectors: &str) -> String {
    let place = |line: &str| match line.split(' ').next() {
        Some("V") => Some(2),
        Some("O") => Some(1),
        _ => None,
    };
    let mut lines: Vec<String> = vectors.lines().map(str::to_owned).collect();
    let (line, place) = lines.iter_mut().find_map(|line| place(line).map(|place| (line, place))).unwrap();
    let mut fields: Vec<String> = line.split(' ').map(str::to_owned).collect();
    let digit = fields[place].pop().and_then(|digit| digit.to_digit(16)).unwrap();
    let _ = write!(fields[place], "{:x}", digit ^ 1);
    *line = fields.join(" ");
    lines.join("\n") + "\n"
}

/// The testbench of the example has the bytes that it expects in its text: the same with the last bit of an answer changed.
fn with_a_wrong_byte(bench: &str) -> String {
    let answer = bench.find("constant pair_answer").unwrap();
    let digit = answer + bench[answer..].find("x\"").unwrap() + 3;
    let other = u32::from_str_radix(&bench[digit..=digit], 16).unwrap() ^ 1;
    format!("{}{other:x}{}", &bench[..digit], &bench[digit + 1..])
}

/// What a testbench counts.
fn mismatches(said: &str) -> u32 {
    let count = said.split(" mismatches ").nth(1).and_then(|rest| rest.split_whitespace().next());
    count.and_then(|count| count.parse().ok()).unwrap_or_else(|| panic!("no count: {said}"))
}

/// Run as any simulator runs it, a testbench prints its one line, without a metavalue on the way; that a mismatch was
/// counted is told by the exit status too.
#[test]
fn a_testbench_says_one_line_and_fails_after_a_mismatch() {
    let Some(tool) = ghdl() else { return };
    let small = [
        ("--width 8 --transform-width 10", true),
        ("--method determinants --width 7 --transform-width 9 --clocks-per-pair 6", true),
        ("--method exact --width 8 --stream-width 128 --exact-clocks 16", true),
    ];
    let others = [
        ("--like-paper --upper sticky --width 8 --transform-width 10", false),
        ("--method determinants --width 7 --transform-width 9 --stream-width 1024", false),
        ("", false),
        ("--like-paper --upper sticky", false),
        ("--method determinants --stream-width 1024", false),
        ("--method determinants --clocks-per-pair 2 --stream-width 512", false),
        ("--method exact --stream-width 1024", false),
    ];
    [share(3, small), in_full(others)].concat().par_iter().for_each(|(options, broken)| {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path();
        succeeds(dir, &format!("generate --out rtl {options}"));
        let ghdl = Ghdl::at(tool, dir);
        ghdl.analyse(&listed(&ghdl, "rtl", "files.txt"));
        let simulate = |bench: &str, vectors: &str| match bench {
            "efsat_uart_tb" => ghdl.run(bench, &[]),
            _ => ghdl.run(bench, &[&format!("-gvectors={vectors}")]),
        };
        // That of the example is also run in `stream`.
        let of_example = in_full(["efsat_uart_tb"]);
        for bench in ["efsat_tb", "efsat_stream_tb"].iter().chain(&of_example) {
            let (fine, said) = simulate(bench, &format!("rtl/{bench}.vec"));
            assert!(fine && mismatches(&said) == 0, "{options}: {said}");
            assert_eq!(said.lines().count(), 1, "{options}: {said}");
        }
        if !broken {
            return;
        }
        for bench in share(2, ["efsat_tb", "efsat_stream_tb"]) {
            let vectors = ghdl.read(&format!("rtl/{bench}.vec"));
            ghdl.write("wrong.vec", &with_a_wrong_answer(&vectors));
            let (fine, said) = simulate(bench, "wrong.vec");
            assert!(!fine && mismatches(&said) > 0, "{options}: {said}");
        }
        for entity in of_example {
            let bench = "rtl/example/efsat_uart_tb.vhd";
            ghdl.write(bench, &with_a_wrong_byte(&ghdl.read(bench)));
            ghdl.analyse(&[bench]);
            let (fine, said) = simulate(entity, "");
            assert!(!fine && mismatches(&said) > 0, "{options}: {said}");
        }
    });
}

/// The licence of generated files, once in each that may have comments: all but lists and vectors.
#[test]
fn ready_files_name_their_licence() {
    let ready = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl-out");
    let (mut folders, mut named) = (vec![ready], 0);
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let (name, text) = (path.to_str().unwrap(), std::fs::read_to_string(&path).unwrap());
            let without = ["files.txt", "files-synthesis.txt", ".vec", ".prj"].iter().any(|end| name.ends_with(end));
            let is_manifest = name.ends_with(".json");
            let found =
                text.lines().take(2).filter(|line| line.contains("SPDX-License-Identifier: MIT OR Apache-2.0")).count();
            let of_manifest = text.matches("\"SPDX-License-Identifier\": \"MIT OR Apache-2.0\"").count();
            let all = (found, of_manifest, text.matches("SPDX").count());
            let expected = if is_manifest {
                (0, 1, 1)
            } else if without {
                (0, 0, 0)
            } else {
                (1, 0, 1)
            };
            assert_eq!(all, expected, "{name}");
            named += found;
        }
    }
    assert!(named > 200, "{named} files");
}

/// The scripts for ISE and Vivado in a Tcl that knows the tools' commands, but for what they do.
#[test]
fn scripts_for_tools_fail_when_the_tool_fails() {
    if !has("tclsh", "tclsh", "/dev/null") {
        return;
    }
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    const ENGINE: &str = "--engine --method axes --width 10 --transform-width 26 --registers";
    for (device, options, script, commands, result) in [
        (
            "xc2v6000-4",
            "--width 8 --transform-width 10",
            "ise/project.tcl",
            "project xfile",
            ["proc process args { return 1 }", "proc process args { return 0 }"],
        ),
        (
            "xc7a200t-1",
            ENGINE,
            "vivado/package_ip.tcl",
            "create_project add_files get_files set_property current_fileset update_compile_order ipx::package_project \
             ipx::current_core ipx::associate_bus_interfaces ipx::infer_bus_interface ipx::create_xgui_files \
             ipx::update_checksums ipx::save_core close_project",
            ["proc ipx::check_integrity args {}", "proc ipx::check_integrity args { error wrong }"],
        ),
        (
            "xc7a200t-1",
            ENGINE,
            "vivado/project.tcl",
            "create_project add_files get_files set_property current_fileset get_runs launch_runs wait_on_run open_run \
             report_utilization report_timing_summary",
            ["proc get_property args { return 100% }", "proc get_property args { return 40% }"],
        ),
    ] {
        succeeds(dir, &format!("generate --out {device} --device {device} {options}"));
        let known: String = commands.split_whitespace().map(|name| format!("proc {name} args {{}}\n")).collect();
        let known = format!("namespace eval ipx {{}}\n{known}");
        let ends = result.map(|result| {
            std::fs::write(dir.join("around.tcl"), format!("{known}{result}\nsource {device}/{script}\n")).unwrap();
            Command::new("tclsh").arg("around.tcl").current_dir(dir).output().unwrap().status.success()
        });
        assert_eq!(ends, [true, false], "{script}");
    }
}
