//! dev
use efsat::artefact::{Prefix, volume::volume_files};
use efsat::design::engine::volume_unit::VolumeDesign;
use efsat::params::{EngineParams, Params};

#[test]
fn prints() {
    for clocks in [4, 2, 1] {
        let design = VolumeDesign::new(&EngineParams { expansion_clocks: clocks, ..EngineParams::default() }, &Params::default()).unwrap();
        println!("E {clocks} latency {} multipliers {} registers {} critical {:?}", design.latency, design.stage.multipliers(), design.stage.register_bits(), design.schedule.critical);
        let dir = format!("/tmp/vol/{clocks}");
        std::fs::create_dir_all(&dir).unwrap();
        for (name, text) in volume_files(&design, &Prefix::default()).unwrap() {
            std::fs::write(format!("{dir}/{name}"), text).unwrap();
        }
        for (schedule, n) in design.schedule.hierarchy() {
            println!("  {} x{n} latency {} reg bits {}", schedule.unit.name, schedule.latency, schedule.register_bits);
        }
    }
}
