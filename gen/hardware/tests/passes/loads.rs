//! Copies of control registers that have too many loads.

use super::*;
use efsat_hardware::netlist::{Driver, MOST_LOADS};
use efsat_hardware::op::Range;

/// Forty values of two phases, chosen by one selector and captured by two strobes.
fn wide() -> Rc<Block> {
    use efsat_hardware::graph::{Phases, Signals};
    const S16: Type = Type::signed(16, 0);
    let all: Range = S16.limits();
    block(2, |top| {
        let inputs: Vec<Sig> = (0..40).map(|i| top.input(S16, all).named_at("x", i)).collect();
        let sums: Vec<Sig> = (0..20)
            .flat_map(|i| {
                let pair = Phases::new(2, |s| Some([inputs[2 * i], inputs[2 * i + 1]][s]));
                let chosen = pair.mux();
                pair.capture(&chosen).map(|(_, value)| value).collect::<Vec<_>>()
            })
            .collect();
        vec![sums[1..].iter().fold(sums[0], |sum, value| sum + *value).named("sum")]
    })
}

#[test]
fn no_control_register_has_more_loads_than_the_limit() {
    let module = lowered(&wide(), 100);
    let loads = module.control_loads();
    let over: Vec<_> = loads.iter().filter(|(_, loads, _)| *loads > MOST_LOADS).collect();
    assert!(over.is_empty(), "{over:?}");
    let copies: Vec<_> = module.signals.iter().filter(|signal| signal.copy_of.is_some()).collect();
    // One selector and two strobes of 320 loads each: four copies of each beside the register itself.
    assert!(copies.len() >= 8, "{}", copies.len());
    for copy in copies {
        let original = module.signal(copy.copy_of.expect("a copy"));
        let same = |s: &Driver| format!("{:?}", std::mem::discriminant(s));
        assert_eq!(same(&copy.driver), same(&original.driver));
        assert!(copy.name().starts_with(&format!("{}_copy", original.name())));
    }
}

/// A gate that enables is copied with its register, or tools would make one gate of the copies.
#[test]
fn gates_are_copied_with_their_registers() {
    let module = module(|m| {
        let [valid, go] = ["valid", "go"].map(|name| m.input(name, Type::FLAG));
        let open = m.register("open", Type::FLAG);
        open.loads(go, None, None);
        let load = (valid & open).named("load");
        for i in 0..20 {
            let x = m.input(format!("x{i}").as_str(), S8);
            let held = m.register(format!("held{i}").as_str(), S8);
            held.loads(x, Some(load), None);
            held.output(format!("y{i}").as_str());
        }
    });
    let names: Vec<String> = module.signals.iter().filter(|s| s.copy_of.is_some()).map(|s| s.name()).collect();
    assert_eq!(names, ["open_copy0", "load_copy0", "open_copy1", "load_copy1"]);
    assert!(module.control_loads().iter().all(|(_, loads, _)| *loads <= MOST_LOADS));
}
