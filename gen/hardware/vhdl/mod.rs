//! Prints a module hierarchy as strict VHDL-93 with `std_logic_1164`, `numeric_std` and one package of the design's types.
//!
//! Bundles become records and arrays; what is done alike with their elements is folded into loops and generate
//! statements. Everything is computed here; the template only prints.

mod entity;
mod fold;
// For the tests of printed files, here and in upper crates.
#[doc(hidden)]
pub mod lint;
mod names;
mod package;
mod shape;
mod view;

pub use entity::generated_instance;
pub use names::{Clash, fault};

use crate::netlist::{Module, SignalId};
use entity::Entity;
use std::collections::{BTreeSet, HashSet};
use std::rc::Rc;

/// Names without their ending, and texts.
type Files = Vec<(String, String)>;

/// Prints a hierarchy: file names without their ending and texts, in the order of compilation, the package first. `package`
/// is its name; `prefix` stands before it and before the names of all entities; `origin` stands above the header of the top.
///
/// # Errors
/// A name that some tool would refuse.
pub fn print(top: &Rc<Module>, prefix: &str, package: &str, origin: &[String]) -> Result<Vec<(String, String)>, Clash> {
    Ok(printed(top, prefix, package, origin, true)?.0)
}

/// The same for a top around which an entity is written by hand: its ports are bundles, as those of all entities below a top. Also
/// its input ports.
///
/// # Errors
/// A name that some tool would refuse.
// For the volume unit.
#[doc(hidden)]
pub fn print_inner(
    top: &Rc<Module>,
    prefix: &str,
    package: &str,
    origin: &[String],
) -> Result<(Files, Vec<Bundle>), Clash> {
    let (files, types) = printed(top, prefix, package, origin, false)?;
    let bundle = |object: shape::Object| Bundle {
        ty: types.name(&object.shape),
        numbers: object
            .members
            .iter()
            .map(|(id, subs)| (top.signal(top.inputs[id.0]), subs))
            .map(|(signal, subs)| (signal.place.to_string(), object.part(subs).to_string(), signal.ty.signed))
            .collect(),
        name: object.name,
    };
    let ports = view::ports(&shape::Records::of(&top.hierarchy()), top).into_iter();
    Ok((files, ports.filter_map(|(input, object)| input.then(|| bundle(object))).collect()))
}

/// The files and the types in them. `raw`: the ports of the top are words.
fn printed(
    top: &Rc<Module>,
    prefix: &str,
    package: &str,
    origin: &[String],
    raw: bool,
) -> Result<(Files, shape::Types), Clash> {
    let package = &format!("{prefix}{package}");
    let modules = top.hierarchy();
    let records = shape::Records::of(&modules);
    let is_top = |module: &Rc<Module>| Rc::ptr_eq(module, top);
    let views: Vec<view::View> = modules.iter().map(|m| view::View::new(m, &records, raw && is_top(m))).collect();
    let mut types = shape::Types::default();
    views.iter().for_each(|view| view.shapes().for_each(|shape| types.include(shape)));
    types.sort();
    let name = |module: &Module| format!("{prefix}{}", module.name);
    let mut in_use: HashSet<String> = modules.iter().map(|m| name(m)).collect();
    in_use.extend(package::names(&types));
    let mut functions = BTreeSet::new();
    let mut files = vec![];
    for (module, view) in modules.iter().zip(&views) {
        let name = name(module);
        names::check(&name, view.declared().iter().map(String::as_str), &in_use)?;
        let entity = Entity::new(view, &types, [prefix, package], if is_top(module) { origin } else { &[] });
        functions.extend(entity.functions());
        files.push((name, entity.text()));
    }
    let text = package::text(package, &types, &functions, &files);
    files.insert(0, (package.to_owned(), text));
    Ok((files, types))
}

/// An input port of a top that [`print_inner`] prints.
#[doc(hidden)]
pub struct Bundle {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: String,
    /// The numbers in it: what each is called in the netlist, which part of the port it is, and whether it is signed; flags are not.
    pub numbers: Vec<(String, String, bool)>,
}

/// What the text of a module declares: the name of each signal or output port, and the signals of the netlist in it.
pub fn declared(top: &Rc<Module>, module: &Module) -> Vec<(String, Vec<SignalId>)> {
    let records = shape::Records::of(&top.hierarchy());
    let view = view::View::new(module, &records, std::ptr::eq(module, &**top));
    let objects = view.objects.into_iter().chain(view.outputs);
    objects.map(|object| (object.name, object.members.iter().map(|member| member.0).collect())).collect()
}

/// What the text calls the numbers at the ports of a module below a top: its inputs, and its outputs, in their order.
pub fn ports(top: &Rc<Module>, module: &Module) -> [Vec<String>; 2] {
    let mut names = [vec![String::new(); module.inputs.len()], vec![String::new(); module.outputs.len()]];
    for (input, object) in view::ports(&shape::Records::of(&top.hierarchy()), module) {
        let of_direction = &mut names[usize::from(!input)];
        object.members.iter().for_each(|(id, subs)| of_direction[id.0] = object.part(subs).to_string());
    }
    names
}
