//! Instances: a function of bundles as an entity of its own.

use super::block::Rate;
use super::build::{Sig, joined};
use super::bundle::Bundle;
use super::signals::Signals;

/// A bundle at a port of that name.
#[derive(Clone)]
pub struct Port<B>(pub &'static str, pub B);

/// The ports of a block: several bundles, each named.
pub trait Ports<'l>: Sized {
    /// The ports with every signal replaced.
    fn each(&self, f: &mut dyn FnMut(Sig<'l>) -> Sig<'l>) -> Self;

    /// Names the signals after the ports.
    fn name(&self);
}

macro_rules! ports {
    ($($($b:ident $i:tt),+;)*) => {
        $(impl<'l, $($b: Bundle<Sig<'l>>),+> Ports<'l> for ($(Port<$b>,)+) {
            fn each(&self, f: &mut dyn FnMut(Sig<'l>) -> Sig<'l>) -> Self {
                ($(Port(self.$i.0, self.$i.1.each(|_, signal| f(signal))),)+)
            }

            fn name(&self) {
                $(self.$i.1.clone().named(self.$i.0);)+
            }
        })*
    };
}

ports! {
    A 0;
    A 0, B 1;
    A 0, B 1, C 2;
    A 0, B 1, C 2, D 3;
    A 0, B 1, C 2, D 3, E 4;
    A 0, B 1, C 2, D 3, E 4, F 5;
}

/// An instance of the block that `body` makes of its ports. Equal blocks of one name are one entity.
///
/// # Panics
/// If two different blocks have the name, or an operand does not fit.
///
/// ```
/// # use efsat_hardware::testing::examples::*;
/// fn twice<'l>(x: Sig<'l>) -> Sig<'l> {
///     instance("twice", &["y = 2 x"], (Port("x", x),), |(Port(_, x),)| (x + x).named("y"))
/// }
/// assert_eq!(value(&[3], |x| twice(x[0])), 6);
/// // The macro says the same.
/// assert_eq!(value(&[3], |x| { let x = x[0]; efsat_hardware::entity!("twice", &[], (x) => (x + x).named("y")) }), 6);
/// ```
pub fn instance<'l, P: Ports<'l>, R: Signals<'l>>(name: &str, doc: &[&str], ports: P, body: impl FnOnce(P) -> R) -> R {
    let mut args: Vec<Sig<'l>> = vec![];
    ports.each(&mut |signal| {
        args.push(signal);
        signal
    });
    let args = joined(&args);
    let (library, columns) = (args[0].library(), args[0].columns());
    let block = library.begin(name, doc, 1, columns);
    let mut given = args.iter();
    let inner = ports.each(&mut |signal| {
        let arg = given.next().expect("one operand for each port");
        let top = super::build::Top::of(signal.library(), block);
        top.port(arg.ty(), arg.ranges(), Rate::Any)
    });
    inner.name();
    let results = body(inner);
    let inner_results: Vec<(crate::op::Type, Rate, Vec<crate::op::Range>)> =
        results.signals().iter().map(|r| (r.ty(), r.rate(), r.ranges())).collect();
    let made = library.finish(block, &results.signals());
    let instance = args[0].instance_of(&made, &args);
    let outputs = inner_results.into_iter().enumerate();
    let outputs: Vec<Sig<'l>> =
        outputs.map(|(i, (ty, rate, ranges))| instance.output_of(i, ty, rate, ranges)).collect();
    results.with(outputs)
}

/// A function of bundles as an entity: `entity!("name", ["what it is"], (x, y) => x + y)`. The parameters are variables,
/// and inside the body the ports of their names.
#[macro_export]
macro_rules! entity {
    ($name:expr, $doc:expr, ($($port:ident),+ $(,)?) => $body:expr) => {
        $crate::graph::instance($name, $doc, ($($crate::graph::Port(stringify!($port), $port),)+), |ports| {
            let ($($crate::graph::Port(_, $port),)+) = ports;
            $body
        })
    };
}
