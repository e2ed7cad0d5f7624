//! Offers stay: VALID, once set, and what comes with it, until READY. Of the stream wrapper, the registers and the engine's read master,
//! as printed, for all time and whatever comes in. Of registers and read master also that nothing is answered that was not asked for.

use super::invariant::Invariant;
use super::unit::Mistake::{Inverted, NotMissing, WrongArm, WrongGate, WrongLastGate};
use efsat::artefact::{FileSet, Packaging, Prefix, design_files_with};
use efsat::design::{Design, Probes};
use efsat::engine::artefact::{EngineDesign, EngineExtras, engine_design_files_with};
use efsat::engine::params::EngineParams;
use efsat::params::{Method, Params};

/// What a channel offers: VALID, READY and the rest of it with its bits, and what withdraws it.
struct Channel {
    name: &'static str,
    valid: &'static str,
    ready: &'static str,
    payload: &'static [(&'static str, u32)],
    withdrawn: &'static str,
}

impl Channel {
    /// What a claim must show of the channel.
    fn stays(&self, claim: &mut Invariant) {
        let Self { name, valid, ready, withdrawn, .. } = self;
        claim.body.push_str(&format!("  reg {name}_kept = 0;\n  always @(posedge clk) {name}_kept <= !reset && !({withdrawn}) && {valid} && !{ready};\n"));
        claim.shown([format!("!{name}_kept || {valid}")]);
        for (signal, bits) in self.payload {
            let was = format!("{name}_{signal}_was");
            claim
                .body
                .push_str(&format!("  reg [{}:0] {was} = 0;\n  always @(posedge clk) {was} <= {signal};\n", bits - 1));
            claim.shown([format!("!{name}_kept || {signal} == {was}")]);
        }
    }
}

/// The texts of files, in this order.
fn texts(set: &FileSet, names: &[&str]) -> Vec<(String, String)> {
    let text = |name: &&str| ((*name).to_owned(), set.get(name).unwrap_or_else(|| panic!("no file {name}")).to_owned());
    names.iter().map(text).collect()
}

fn unit_files() -> FileSet {
    let params = Params { width: 8, transform_width: 10, ..Params::default() };
    let design = Design::new(&params, Probes::None).expect("a design");
    let packaging = Packaging { registers: true, ..Packaging::default() };
    design_files_with(&design, &packaging, "efsat generate").expect("legal names")
}

fn engine_files() -> FileSet {
    let unit = Params { width: 10, transform_width: 26, method: Method::Axes, ..Params::default() };
    let params = EngineParams { watchdog: 1000, ..EngineParams::default() };
    let design = EngineDesign::new(&params, &unit).expect("an engine");
    let extras = EngineExtras { registers: true, ..EngineExtras::default() };
    engine_design_files_with(&design, &Prefix::default(), "efsat generate --engine", "", &extras).expect("legal names")
}

/// The registers around the unit, or around the engine with its caches.
pub fn registers(of_engine: bool) -> Invariant {
    let set = if of_engine { engine_files() } else { unit_files() };
    let files = texts(&set, &["efsat_register_map.vhd", "efsat_registers.vhd"]);
    let sizes = if of_engine { "around the engine" } else { "around the unit" };
    let property = "offers stay; a response for each access; queues within bounds";
    let mut claim = Invariant::new("efsat_registers", property, sizes.to_owned(), files);
    claim.clocking = ".aclk(clk), .aresetn(!reset), .s_axi_awprot(3'b0), .s_axi_arprot(3'b0)";
    claim.inputs = vec![
        "[11:0] awaddr",
        "awvalid",
        "[31:0] wdata",
        "[3:0] wstrb",
        "wvalid",
        "bready",
        "[11:0] araddr",
        "arvalid",
        "rready",
        "m_ready",
        "[63:0] s_data",
        "s_valid",
        "s_last",
    ];
    let lite = [
        "awaddr", "awvalid", "awready", "wdata", "wstrb", "wvalid", "wready", "bresp", "bvalid", "bready", "araddr",
        "arvalid", "arready", "rdata", "rresp", "rvalid", "rready",
    ];
    claim.ports = lite.iter().map(|name| format!(".s_axi_{name}({name})")).collect();
    let streams = [
        ("m_axis_tdata", "m_data"),
        ("m_axis_tvalid", "m_valid"),
        ("m_axis_tlast", "m_last"),
        ("m_axis_tready", "m_ready"),
        ("s_axis_tdata", "s_data"),
        ("s_axis_tvalid", "s_valid"),
        ("s_axis_tlast", "s_last"),
        ("s_axis_tready", "s_ready"),
        ("irq", "irq"),
        ("clear_core", "clear_core"),
    ];
    claim.ports.extend(streams.map(|(port, name)| format!(".{port}({name})")));
    claim.body.push_str(
        "  wire awready, wready, bvalid, arready, rvalid, irq, clear_core, m_valid, m_last, s_ready;
  wire [1:0] bresp, rresp; wire [31:0] rdata; wire [63:0] m_data;
  reg [1:0] addresses = 0, words = 0, asked = 0;
  always @(posedge clk)
    if (reset) begin
      addresses <= 0; words <= 0; asked <= 0;
    end else begin
      addresses <= addresses + (awvalid && awready) - (bvalid && bready);
      words <= words + (wvalid && wready) - (bvalid && bready);
      asked <= asked + (arvalid && arready) - (rvalid && rready);
    end
  wire [6:0] transmit_held = transmit_written - transmit_read, receive_held = receive_written - receive_read;
",
    );
    claim.see(&[("write_address_there", 1), ("write_word_there", 1), ("read_address_there", 1), ("running", 1)]);
    claim.see(&[("transmit_written", 7), ("transmit_read", 7), ("receive_written", 7), ("receive_read", 7)]);
    let channels = [
        Channel { name: "b", valid: "bvalid", ready: "bready", payload: &[("bresp", 2)], withdrawn: "0" },
        Channel {
            name: "r",
            valid: "rvalid",
            ready: "rready",
            payload: &[("rresp", 2), ("rdata", 32)],
            withdrawn: "0",
        },
        Channel {
            name: "m",
            valid: "m_valid",
            ready: "m_ready",
            payload: &[("m_data", 64), ("m_last", 1)],
            withdrawn: "clear_core",
        },
    ];
    channels.iter().for_each(|channel| channel.stays(&mut claim));
    // What was taken and not answered: nothing is answered that was not asked for, and everything once.
    claim.shown([
        "addresses == write_address_there + bvalid",
        "words == write_word_there + bvalid",
        "asked == read_address_there + rvalid",
    ]);
    claim.shown(["transmit_held <= 64", "receive_held <= 64"]);
    // No interrupt is lost, or comes from nothing.
    claim.see(&[("events", 5), ("cleared", 5), ("pending", 5)]);
    claim
        .body
        .push_str("  reg [4:0] due = 0;\n  always @(posedge clk) due <= reset ? 4 : pending & ~cleared | events;\n");
    claim.shown(["pending == due"]);
    claim.mutants(&[(WrongGate, "writes"), (NotMissing, "writes"), (NotMissing, "reads"), (NotMissing, "offer_free")]);
    claim.mutants(&[
        (NotMissing, "write_address_free"),
        (NotMissing, "write_word_free"),
        (NotMissing, "read_address_free"),
    ]);
    claim.mutants(&[(WrongGate, "transmit_pop"), (WrongArm, "receive_pop"), (Inverted, "transmit_full")]);
    claim.mutants(&[(NotMissing, "pending_next"), (WrongLastGate, "pending_next")]);
    claim
}

/// What the unit gives to its wrapper: ready for a pair and a pose, and its answer with its bits.
const READY: [&str; 2] = ["pair_ready", "pose_ready"];
const ANSWER: [(&str, u32); 5] =
    [("out_verdict", 2), ("out_tag", 16), ("out_separated", 11), ("out_overlapping", 11), ("out_outside", 1)];

/// The stream wrapper around any unit whose answer stays until it is taken, which is what [the queue of answers](super::queues) shows
/// of every unit: an answer that was not taken is that of the clock before, any other is free.
pub fn wrapper() -> Invariant {
    let set = unit_files();
    let mut text = set.get("efsat_stream.vhd").expect("the wrapper").to_owned();
    let from = text.find("  unit : entity work.efsat").expect("the unit");
    let to = from + text[from..].find(");\n").expect("its end") + 3;
    text.replace_range(from..to, "");
    for name in READY.into_iter().chain(["out_valid", "out_ready"]).chain(ANSWER.map(|(name, _)| name)) {
        let from = text.find(&format!("  signal {name} : ")).unwrap_or_else(|| panic!("no signal {name}"));
        let to = from + text[from..].find('\n').expect("a line") + 1;
        let declaration =
            text[from..to].split_once(" : ").and_then(|(_, ty)| ty.split_once(';')).expect("a type").0.to_owned();
        text.replace_range(from..to, "");
        let direction = if name == "out_ready" { "out" } else { "in" };
        text = text.replacen("  port (\n", &format!("  port (\n    {name} : {direction} {declaration};\n"), 1);
    }
    let files = vec![("efsat_stream.vhd".to_owned(), text)];
    let mut claim = Invariant::new("efsat_stream", "answers stay", "around any unit".to_owned(), files);
    claim.clocking = ".aclk(clk), .aresetn(!reset)";
    claim.inputs = vec![
        "[63:0] s_data",
        "[7:0] s_keep",
        "s_valid",
        "s_last",
        "m_ready",
        "pair_ready",
        "pose_ready",
        "any_valid",
        "[1:0] any_verdict",
        "[15:0] any_tag",
        "[10:0] any_separated",
        "[10:0] any_overlapping",
        "any_outside",
    ];
    let ports = [
        ("s_axis_tdata", "s_data"),
        ("s_axis_tkeep", "s_keep"),
        ("s_axis_tvalid", "s_valid"),
        ("s_axis_tlast", "s_last"),
        ("m_axis_tdata", "m_data"),
        ("m_axis_tvalid", "m_valid"),
        ("m_axis_tlast", "m_last"),
        ("m_axis_tready", "m_ready"),
    ];
    claim.ports = ports.map(|(port, name)| format!(".{port}({name})")).into();
    let of_unit = READY.into_iter().chain(["out_valid", "out_ready"]).chain(ANSWER.map(|(name, _)| name));
    claim.ports.extend(of_unit.map(|name| format!(".{name}({name})")));
    claim.body.push_str(
        "  wire m_valid, m_last; wire [63:0] m_data;
  wire [5:0] owed = owed_count - given_count;
  wire out_ready; reg unit_kept = 0; wire out_valid = unit_kept || any_valid;
  always @(posedge clk) unit_kept <= !reset && out_valid && !out_ready;
",
    );
    for (name, bits) in ANSWER {
        let any = name.replacen("out_", "any_", 1);
        claim.body.push_str(&format!(
            "  reg [{high}:0] {name}_was = 0; wire [{high}:0] {name} = unit_kept ? {name}_was : {any};
  always @(posedge clk) {name}_was <= {name};\n",
            high = bits - 1
        ));
    }
    claim.see(&[("owed_count", 6), ("given_count", 6)]);
    claim.shown(["owed <= 32"]);
    Channel {
        name: "m",
        valid: "m_valid",
        ready: "m_ready",
        payload: &[("m_data", 64), ("m_last", 1)],
        withdrawn: "0",
    }
    .stays(&mut claim);
    claim.mutants(&[(NotMissing, "word_ready"), (WrongGate, "answer_valid"), (WrongGate, "answer_taken")]);
    claim
}

/// The read master: an address that is offered stays.
pub fn read_master() -> Invariant {
    let set = engine_files();
    let files = texts(&set, &["engine_layout.vhd", "engine_read_master.vhd"]);
    let mut claim =
        Invariant::new("engine_read_master", "addresses stay, through a soft reset too", "64 bits".to_owned(), files);
    claim.inputs = vec![
        "restart",
        "[3:0] ask_valid",
        "[25:0] a0",
        "[25:0] a1",
        "[25:0] a2",
        "[25:0] a3",
        "arready",
        "[63:0] rdata",
        "[1:0] rresp",
        "rlast",
        "rvalid",
    ];
    let ports = [
        ("restart", "restart"),
        ("ask_valid", "ask_valid"),
        ("ask_address_0", "a0"),
        ("ask_address_1", "a1"),
        ("ask_address_2", "a2"),
        ("ask_address_3", "a3"),
        ("m_axi_araddr", "araddr"),
        ("m_axi_arlen", "arlen"),
        ("m_axi_arvalid", "arvalid"),
        ("m_axi_arready", "arready"),
        ("m_axi_rdata", "rdata"),
        ("m_axi_rresp", "rresp"),
        ("m_axi_rlast", "rlast"),
        ("m_axi_rvalid", "rvalid"),
        ("m_axi_rready", "rready"),
    ];
    claim.ports = ports.map(|(port, name)| format!(".{port}({name})")).into();
    claim.body.push_str("  wire arvalid, rready; wire [31:0] araddr; wire [7:0] arlen;\n");
    Channel {
        name: "ar",
        valid: "arvalid",
        ready: "arready",
        payload: &[("araddr", 32), ("arlen", 8)],
        withdrawn: "0",
    }
    .stays(&mut claim);
    claim.shown(["rready"]);
    claim.mutants(&[(NotMissing, "free"), (WrongGate, "accepts")]);
    claim
}
