//! The cross product of two interval vectors: one axis (equation 1).

use super::interval::{self, Bounds, Rounding};
use super::multiply;
use efsat_hardware::graph::{Builder, Rate, Type, Unit};
use efsat_hardware::number::Upper;
use std::rc::Rc;

/// Coordinate names, also of ports.
pub const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// What the cross product works on.
pub struct Spec<'a> {
    /// Bits of every operand and of the result.
    pub bits: u32,
    /// Bound on the left factor's components, as mantissa.
    pub left: i128,
    /// Bound on the right factor's components.
    pub right: i128,
    /// The roundings that occur, chosen by the `rounding` port where there are several.
    pub roundings: &'a [Rounding],
    /// Rule for upper bounds.
    pub upper: Upper,
    /// Formats by kind of axis, for the header.
    pub notes: &'a [String],
    /// The [sign case](multiply::sign_case_unit) of an operand.
    pub sign_case: &'a Rc<Unit>,
}

/// Unsigned bits that count to `ways`.
pub fn select_bits(ways: usize) -> u32 {
    usize::BITS - (ways.max(2) - 1).leading_zeros()
}

/// `l = e x f`: component i is `e_j f_k - e_k f_j`, accumulated exactly and rounded once. Twelve multipliers at up to
/// 18 bits.
pub fn unit(spec: &Spec) -> Rc<Unit> {
    let mut doc = vec![
        "One separating axis, l = e x f in interval arithmetic (equation 1).",
        "Component i is e_j f_k - e_k f_j, exact, then rounded outward once.",
        "Ports carry mantissas; where the binary point is depends on the kind of axis:",
    ];
    doc.extend(spec.notes.iter().map(String::as_str));
    let mut b = Builder::new("cross_product", 1, &doc);
    let ty = Type::signed(spec.bits, 0);
    let vector = |b: &mut Builder, name: &str, bound| {
        COORDINATES.map(|c| interval::input(b, &format!("{name}_{c}"), ty, interval::symmetric(bound)))
    };
    let e = vector(&mut b, "e", spec.left);
    let f = vector(&mut b, "f", spec.right);
    let several = spec.roundings.len() > 1;
    let select = several.then(|| {
        let ty = Type::unsigned(select_bits(spec.roundings.len()));
        b.input("rounding", ty, (0, spec.roundings.len() as i128 - 1), Rate::Any)
    });
    let mut factors = |side: &str, x: [Bounds; 3]| {
        [0, 1, 2].map(|i| multiply::factor(&mut b, &format!("{side}_{}", COORDINATES[i]), spec.sign_case, x[i]))
    };
    let (e, f) = (factors("e", e), factors("f", f));
    let multiply = multiply::multiply_unit("axis_multiply", (ty, spec.left), (ty, spec.right));
    let wide = multiply.node(multiply.outputs[0].1).ty;
    let product_range = interval::symmetric(spec.left * spec.right);
    let subtract = interval::subtract_unit("axis_subtract", (wide, product_range), (wide, product_range), None);
    for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
        let names = COORDINATES;
        let times = |b: &mut Builder, j: usize, k: usize| {
            let name = format!("e_{}_f_{}", names[j], names[k]);
            multiply::instance(b, &name, &multiply, e[j], f[k])
        };
        let plus = times(&mut b, j, k);
        let minus = times(&mut b, k, j);
        let name = format!("l_{}", names[i]);
        let exact = interval::instance(&mut b, &format!("{name}_exact"), &subtract, &[plus, minus], &[])[0];
        let l =
            interval::round(&mut b, &format!("{name}_rounded"), exact, spec.roundings, select, spec.upper, spec.bits);
        let equation = format!("e_{} f_{} - e_{} f_{}", names[j], names[k], names[k], names[j]);
        b.comment(l.lo, format!("lower bound of {equation}"));
        b.comment(l.hi, format!("upper bound of {equation}"));
        interval::output(&mut b, &name, l);
    }
    b.finish()
}
