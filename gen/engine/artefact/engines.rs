//! Several engines behind one stream and one read port.

use super::EngineDesign;
use crate::params::MemoryPorts;
use crate::words::EngineReport;
use efsat_unit::parts::Core;

/// They as a core.
pub(super) const CORE: Core = Core {
    name: "engines",
    what: "Collision engines of EFSAT behind one stream",
    entity: "efsat_engines",
    label: "engines",
    stem: "efsat_engines",
    played: "sim",
    report_words: EngineReport::WORDS,
    in_order: false,
    packets: &[],
};

/// What is around the engines, in the order of the data.
pub(super) const ENTITIES: [(&str, &str); 4] = [
    ("engines_dispatch", "Packets in: a query goes to the engine that has the fewest."),
    ("efsat_engine", "An engine; those below are its entities."),
    ("engines_gather", "Answers out, one packet behind the other."),
    ("engines_queue", "Answers of one engine that wait for their turn."),
];

/// What is between them and one read port.
pub(super) const SHARED_MEMORY: (&str, &str) = ("engines_memory", "One AXI4 read port for all engines.");

/// What the header of the top says.
pub(super) fn description(design: &EngineDesign) -> Vec<String> {
    let count = design.params.engines;
    let lines = [
        match design.params.memory_ports {
            MemoryPorts::One => format!("{count} collision engines behind one stream and one AXI4 read port."),
            MemoryPorts::Each => {
                format!("{count} collision engines behind one stream, each with an AXI4 read port: engine 0 has m0_axi.")
            }
        },
        String::new(),
        "In: the packets of one engine (see efsat_engine). A query goes to the engine that has the fewest; pairs and poses go to".to_owned(),
        "the first one, in order.".to_owned(),
        "Out: the answers, each in one piece, in any order; a report has the number of its query. Those to pairs and poses are in".to_owned(),
        "order.".to_owned(),
    ];
    lines.to_vec()
}
