//! The checks of the engine's driver in Verilator: each is broken by a mistake in the VHDL, and has to complain.

use crate::tools::{made, replaced};
use efsat::artefact::Prefix;
use efsat::engine::artefact::samples::{cuboid, hills, turn};
use efsat::engine::artefact::{EngineDesign, engine_files};
use efsat::engine::host::{Image, Numbers, memory};
use efsat::engine::model::Query;
use efsat::engine::params::EngineParams;
use efsat::engine::words::{Command, EngineReport, Reason};
use efsat::evidence::cosim::engine::{Channel, Machine, Packet, Step};
use efsat::mesh::Mesh;
use efsat::params::Params;
use std::rc::Rc;

/// Signals between the entities and the ports of the top, and what breaks the rules in a query by its number.
const SIGNALS: &str = "  signal raw_araddr : std_logic_vector(31 downto 0);
  signal raw_arlen : std_logic_vector(7 downto 0);
  signal raw_arsize : std_logic_vector(2 downto 0);
  signal raw_arburst : std_logic_vector(1 downto 0);
  signal raw_arvalid : std_logic;
  signal raw_rready : std_logic;
  signal raw_tdata : std_logic_vector(63 downto 0);
  signal raw_tvalid : std_logic;
  signal toggle : std_logic := '0';
  signal stuck : std_logic := '0';
  signal mistake : integer range 0 to 15;
";
const STATEMENTS: &str = "  mistake <= to_integer(unsigned(number(3 downto 0))) when running = '1' else 0;
  flip : process (aclk)
  begin
    if rising_edge(aclk) then
      toggle <= not toggle;
      if mistake = 12 then
        stuck <= '1';
      end if;
    end if;
  end process flip;
  m_axi_araddr <= raw_araddr xor x\"00000040\" when mistake = 1 and toggle = '1' else
    raw_araddr xor x\"00100000\" when mistake = 3 else
    raw_araddr xor x\"00000020\" when mistake = 4 else
    raw_araddr;
  m_axi_arvalid <= raw_arvalid and toggle when mistake = 2 else
    '1' when mistake = 8 and raw_araddr /= x\"00000000\" else
    raw_arvalid;
  m_axi_arlen <= x\"0f\" when mistake = 5 else raw_arlen;
  m_axi_arsize <= \"010\" when mistake = 6 else raw_arsize;
  m_axi_arburst <= \"00\" when mistake = 7 else raw_arburst;
  m_axi_rready <= raw_rready and toggle when mistake = 9 else raw_rready;
  m_axis_tdata <= raw_tdata xor x\"0000000000000100\" when mistake = 10 and toggle = '1' else raw_tdata;
  m_axis_tvalid <= raw_tvalid and toggle when mistake = 11 else
    '0' when stuck = '1' else
    raw_tvalid;
";

/// What is said of mistakes 1 to 12, and whether it takes gaps to see it.
const COMPLAINTS: [(&str, bool); 12] = [
    ("an address changed before it was taken", true),
    ("an address changed before it was taken", true),
    ("a read outside the trees of the queries", false),
    ("a burst of 64 bytes at byte", false),
    ("a burst of 128 bytes at byte", false),
    ("a burst that is not of whole words one after the other", false),
    ("a burst that is not of whole words one after the other", false),
    ("too many bursts", false),
    ("RREADY is not set", false),
    ("an answer changed before it was taken", true),
    ("an answer changed before it was taken", true),
    ("no transfer any more", false),
];

/// An engine whose unit is compiled fast, with a change of the text of its top; none, where a tool is missing.
fn machine(change: impl Fn(String) -> String) -> Option<Machine> {
    let unit = Params { width: 10, transform_width: 26, ..Params::default() };
    let engine = EngineParams { block_lines: 32, triangle_lines: 16, ..EngineParams::default() };
    let design = EngineDesign::new(&engine, &unit).unwrap();
    let mut files = engine_files(&design, &Prefix::default(), "efsat generate --engine").unwrap();
    let (_, top) = files.last_mut().unwrap();
    *top = change(std::mem::take(top));
    made(Machine::of(design, &files, None))
}

/// The top with its outputs behind what breaks them.
fn breakable(mut top: String) -> String {
    for (port, raw) in [
        ("m_axi_araddr", "raw_araddr"),
        ("m_axi_arlen", "raw_arlen"),
        ("m_axi_arsize", "raw_arsize"),
        ("m_axi_arburst", "raw_arburst"),
        ("m_axi_arvalid", "raw_arvalid"),
        ("m_axi_rready", "raw_rready"),
        ("m_axis_tdata", "raw_tdata"),
        ("m_axis_tvalid", "raw_tvalid"),
    ] {
        top = replaced(&top, &format!("{port} => {port}"), &format!("{port} => {raw}"));
    }
    let top = replaced(
        &top,
        "architecture rtl of efsat_engine is\n",
        &format!("architecture rtl of efsat_engine is\n{SIGNALS}"),
    );
    replaced(&top, "begin\n  reset <= not aresetn;\n", &format!("begin\n  reset <= not aresetn;\n{STATEMENTS}"))
}

/// One query by its number; what is said of it.
fn complaint(machine: &Machine, number: u32, gaps: bool) -> Option<String> {
    let design = machine.design();
    let numbers = Numbers::new(&design.params, &design.unit.params).unwrap();
    let images = Image::build(&[&hills(6), &cuboid(3, 4, 2)], &design.format).unwrap();
    let images: Vec<&Image> = images.iter().collect();
    let (_, sides) = memory(&images);
    let query = numbers.query([(images[0], sides[0]), (images[1], sides[1])], &turn(2), &[2.5, 1.0, -1.0]).unwrap();
    // So slow that many bursts are under way; the query takes less than the patience.
    let channel = Channel { latency: 200..=200, gaps, patience: 100_000, ..Channel::default() };
    machine.run(&images, &[Query { number, ..query }], &channel).err().map(|error| error.to_string())
}

#[test]
#[ignore = "compiles two engines: scripts/test full"]
fn every_check_of_the_protocols_complains() {
    let Some(broken) = machine(breakable) else { return };
    for gaps in [false, true] {
        assert_eq!(complaint(&broken, 0, gaps), None);
    }
    for (number, (expected, gaps)) in (1..).zip(COMPLAINTS) {
        let found = complaint(&broken, number, gaps).unwrap_or_default();
        assert!(found.contains(expected), "mistake {number}: {found:?}; expected {expected}");
    }
    // In reset no query has a number.
    let offers = |top: String| {
        let top = replaced(&top, "m_axis_tvalid => m_axis_tvalid", "m_axis_tvalid => raw_tvalid");
        let top = replaced(
            &top,
            "  signal reset : std_logic;\n",
            "  signal reset : std_logic;\n  signal raw_tvalid : std_logic;\n",
        );
        replaced(
            &top,
            "  reset <= not aresetn;\n",
            "  reset <= not aresetn;\n  m_axis_tvalid <= raw_tvalid or reset;\n",
        )
    };
    let Some(offers) = machine(offers) else { return };
    assert!(complaint(&offers, 0, false).unwrap_or_default().contains("a handshake in reset"));
}

/// The engine with the smallest caches, two pairs in flight, and a query about a mesh and the mesh turned.
struct Alone {
    machine: Rc<Machine>,
    memory: Vec<u64>,
    query: Query,
}

/// What comes back for the query: pairs in ascending order, and what does not depend on time of the report.
type Due = (Vec<u64>, [u64; 4]);

impl Alone {
    /// A query about two boxes that cross, and a short one about sides of them.
    fn both() -> Option<[Self; 2]> {
        let unit = Params { width: 10, transform_width: 26, ..Params::default() };
        let engine = EngineParams {
            block_lines: 16,
            triangle_lines: 16,
            in_flight: 2,
            stack: 3 * 10 + 2,
            tree_height: 10,
            ..EngineParams::default()
        };
        let design = EngineDesign::new(&engine, &unit).unwrap();
        let numbers = Numbers::new(&engine, &unit).unwrap();
        let files = engine_files(&design, &Prefix::default(), "efsat generate --engine").unwrap();
        let format = design.format;
        let machine = Rc::new(made(Machine::of(design, &files, None))?);
        let whole = cuboid(1, 1, 1);
        let side = Mesh::new(whole.vertices().to_vec(), whole.faces()[4..6].to_vec()).unwrap();
        Some([(whole, 0.5), (side, -0.25)].map(|(mesh, y)| {
            let image = Image::build(&[&mesh], &format).unwrap().remove(0);
            let (memory, sides) = memory(&[&image]);
            let query = numbers.query([(&image, sides[0]); 2], &turn(2), &[0.25, y, 0.5]).unwrap();
            Self { machine: Rc::clone(&machine), memory, query }
        }))
    }

    /// The query; it does not wait until those before it are done.
    fn ask(&self, number: u32) -> Step {
        Step::Packet(Query { number, keep_caches: true, ..self.query.clone() }.words(&self.machine.design().format))
    }

    fn play(&self, latency: u32, steps: &[Step]) -> Vec<Packet> {
        let channel = Channel { latency: latency..=latency, patience: 400_000, ..Channel::default() };
        self.machine.play(&self.memory, steps, &channel).unwrap()
    }

    /// Reason, number, and what is due, of an answer.
    fn read(packet: &Packet) -> (Reason, u32, Due) {
        let (pairs, report) = packet.words.split_last_chunk::<{ EngineReport::WORDS }>().unwrap();
        let mut pairs = pairs.to_vec();
        pairs.sort_unstable();
        let EngineReport { reason, number, .. } = EngineReport::of(report).unwrap();
        (reason, number, (pairs, [report[0] & 0xff, report[1], report[2], report[3]]))
    }
}

/// The engine alone is reset at every clock of two queries in flight, while memory goes on: by the stream and by the port, also
/// between the words of a packet. Every query that follows is right. A stop around the end of the first of two queries never ends
/// the second.
#[test]
#[ignore = "compiles an engine: scripts/test full"]
fn every_query_after_a_reset_or_a_stop_is_right() {
    let Some([alone, short]) = Alone::both() else { return };
    let format = alone.machine.design().format;
    let order = |command, number| Step::Packet(vec![format.order(command, number)]);
    for (latency, alone) in [(1, &alone), (30, &alone), (60, &alone), (160, &alone), (400, &alone), (1200, &short)] {
        let first = alone.play(latency, &[alone.ask(1), alone.ask(2)]);
        let (reason, _, due) = Alone::read(&first[0]);
        assert!(reason == Reason::Complete && !due.0.is_empty(), "{first:?}");
        let clocks = first[1].clock as usize + 40;
        let Step::Packet(words) = alone.ask(4) else { unreachable!() };
        // A copy of the engine is reset in each of these clocks.
        let mut steps = vec![alone.ask(1), alone.ask(2)];
        steps.extend((0..=clocks).map(|i| {
            let mut apart = match i % 3 {
                0 => vec![Step::SoftReset],
                1 => vec![order(Command::Reset, i as u32 & 0xffff)],
                _ => {
                    let (begun, rest) = words.split_at(1 + i % (words.len() - 1));
                    vec![Step::Begin(begun.to_vec()), Step::SoftReset, Step::Packet(rest.to_vec())]
                }
            };
            apart.extend([alone.ask(3), Step::Wait]);
            Step::Apart(apart)
        }));
        let answers = alone.play(latency, &steps);
        let mut answers = answers.iter().map(Alone::read).peekable();
        let mut before = 0;
        for i in 0..=clocks {
            let at = format!("latency {latency}, reset in clock {i} of {clocks}");
            // Of a copy that was faster than its reset, or of the engine itself.
            while let Some(whole) = answers.next_if(|(reason, ..)| *reason != Reason::Reset) {
                let number = if whole.1 == 1 { 1 } else { 2 };
                assert_eq!(whole, (Reason::Complete, number, due.clone()), "{at}");
                before += 1;
            }
            let (reason, number, _) = answers.next().expect(&at);
            let sent = if i % 3 == 1 { i as u32 & 0xffff } else { 0 };
            assert_eq!((reason, number), (Reason::Reset, sent), "{at}");
            assert_eq!(answers.next(), Some((Reason::Complete, 3, due.clone())), "{at}");
        }
        assert_eq!(answers.next(), None);
        assert!(before > 0, "latency {latency}: no reset came behind the answer");
    }

    // The caches are full from the second time on.
    let first = alone.play(30, &[alone.ask(5), alone.ask(6), Step::Wait, alone.ask(5), alone.ask(6)]);
    let due: Vec<Due> = first[..2].iter().map(|packet| Alone::read(packet).2).collect();
    // Counted from the last word of the second query.
    let clocks = (first[2].clock - first[1].clock) as u32;
    let end = clocks.saturating_sub(2 * format.query_words());
    let pauses = end.saturating_sub(100)..end + 60;
    let steps: Vec<Step> = pauses
        .flat_map(|pause| [alone.ask(5), alone.ask(6), Step::Pause(pause), order(Command::Stop, 5), Step::Wait])
        .collect();
    let mut stopped = [0; 2];
    for pair in alone.play(30, &steps).chunks(2) {
        let [(reason, 5, words), second] = [0, 1].map(|i| Alone::read(&pair[i])) else { panic!("{pair:?}") };
        assert_eq!(second, (Reason::Complete, 6, due[1].clone()));
        match reason {
            Reason::Complete => assert_eq!(words, due[0]),
            other => assert_eq!(other, Reason::Stopped),
        }
        stopped[usize::from(reason == Reason::Stopped)] += 1;
    }
    assert!(stopped.iter().all(|&count| count > 10), "{stopped:?}");
}
