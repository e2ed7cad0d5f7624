//! The units of a design as a table for its README: what each does, how often it is there, latency and multipliers.

use super::Prefix;
use crate::design::Design;
use efsat_hardware::netlist::Module;
use std::collections::HashMap;
use std::rc::Rc;

/// A row of the table.
pub(super) struct UnitRow {
    /// The entity.
    pub name: String,
    /// The first sentence of its description.
    pub what: String,
    /// Instances in the whole design.
    pub instances: usize,
    /// Clocks from its inputs to its outputs; a dash for control logic, which has no fixed latency.
    pub latency: String,
    /// Multipliers in one instance, everything inside included.
    pub multipliers: usize,
}

/// One row per unit: the top first, every unit before those inside it, and otherwise in the order of the data.
pub(super) fn units(design: &Design, prefix: &Prefix) -> Vec<UnitRow> {
    fn visit(module: &Rc<Module>, found: &mut Vec<Rc<Module>>, instances: &mut HashMap<*const Module, usize>) {
        let count = instances.entry(Rc::as_ptr(module)).or_default();
        *count += 1;
        if *count == 1 {
            found.push(Rc::clone(module));
        }
        module.instances.iter().for_each(|instance| visit(&instance.module, found, instances));
    }
    let (mut found, mut instances) = (vec![], HashMap::new());
    visit(&design.top, &mut found, &mut instances);
    let latency = |module: &Rc<Module>| {
        let clocks = if Rc::ptr_eq(module, &design.top) { Some(design.latency as i32) } else { module.latency };
        clocks.map_or_else(|| "-".to_owned(), |clocks| clocks.to_string())
    };
    let row = |module: &Rc<Module>| UnitRow {
        name: prefix.of(&module.name),
        what: first_sentence(&module.doc),
        instances: instances[&Rc::as_ptr(module)],
        latency: latency(module),
        multipliers: module.multipliers(),
    };
    found.iter().map(row).collect()
}

/// The first sentence of a module's description, as a cell of a table. A dot between blanks is a dot product. Where
/// indented formulas follow before the sentence ends, it is cut at its first colon.
pub(super) fn first_sentence(doc: &[String]) -> String {
    let words = |line: &&String| !line.is_empty() && !line.starts_with(' ');
    let paragraph: Vec<&str> = doc.iter().take_while(words).map(|line| line.trim()).collect();
    let text = paragraph.join(" ").replace('|', "\\|");
    if let Some((at, _)) = text.match_indices(". ").find(|(at, _)| !text[..*at].ends_with(' ')) {
        return text[..=at].to_owned();
    }
    match text.split_once(": ").map(|(before, _)| before).or_else(|| text.strip_suffix(':')) {
        Some(before) if !text.ends_with('.') => format!("{before}."),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;

    #[test]
    fn the_units_of_the_default_design_in_the_order_of_the_data() {
        let design = Design::new(&Params::default(), false).unwrap();
        let rows = units(&design, &Prefix::default());
        let at = |name: &str| rows.iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no row {name}"));
        assert_eq!((at("efsat"), rows.len()), (0, design.top.hierarchy().len()));
        let order = ["pair_pipeline", "transform_row", "renormalise_offset", "renormalise_shift", "renormalise_scale"];
        let order = order.iter().chain(&["cross_product", "projection", "comparator_network"]);
        assert!(order.map(|name| at(name)).is_sorted());
        let top = &rows[0];
        assert_eq!((top.instances, top.latency.as_str(), top.multipliers), (1, &*design.latency.to_string(), 48));
        let projection = &rows[at("projection")];
        assert_eq!((projection.instances, projection.multipliers), (4, 6));
        assert_eq!(rows[at("sequencer")].latency, "-");
        let multiplier = &rows[at("multiply_18_18")];
        assert_eq!((multiplier.instances, multiplier.multipliers), (48, 1), "every multiplier is an entity of its own");
    }

    #[test]
    fn a_dot_product_does_not_end_a_sentence() {
        let doc = ["p = v . l in interval", "arithmetic. Then more."].map(str::to_owned);
        assert_eq!(first_sentence(&doc), "p = v . l in interval arithmetic.");
        assert_eq!(first_sentence(&["no end | ".to_owned(), String::new(), "b.".to_owned()]), "no end \\|");
        let formula = ["One axis decided: a, then", "  a = b", "  c = d"].map(str::to_owned);
        assert_eq!(first_sentence(&formula), "One axis decided.");
        let formula = ["One axis decided by:", "  a = b"].map(str::to_owned);
        assert_eq!(first_sentence(&formula), "One axis decided by.");
    }
}
