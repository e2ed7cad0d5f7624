//! The projection of one point on an axis: an interval dot product (equation 2).

use super::cross_product::{COORDINATES, select_bits};
use super::interval::{self, Bounds, Rounding};
use super::multiply::{self, Factor, SIGN_CASE};
use efsat_hardware::graph::{Builder, Rate, Type, Unit};
use efsat_hardware::number::Upper;
use std::rc::Rc;

/// What the projection works on.
pub struct Spec<'a> {
    /// Bits of every operand and of the result.
    pub bits: u32,
    /// Bound on coordinates, as mantissa.
    pub point: i128,
    /// Bound on axis components, as mantissa.
    pub axis: i128,
    /// The roundings that occur, chosen by the `rounding` port where there are several.
    pub roundings: &'a [Rounding],
    /// Rule for upper bounds.
    pub upper: Upper,
    /// Formats by kind of axis, for the header.
    pub notes: &'a [String],
}

/// `p = v * l = (v_x l_x + v_y l_y) + v_z l_z`, accumulated exactly and rounded once. Six multipliers at up to 18 bits.
pub fn unit(spec: &Spec) -> Rc<Unit> {
    let mut doc = vec![
        "Projection of one point on the axis, p = v * l in interval arithmetic (equation 2).",
        "(v_x l_x + v_y l_y) + v_z l_z, exact, then rounded outward once.",
        "Ports carry mantissas; where the binary point is depends on the kind of axis:",
    ];
    doc.extend(spec.notes.iter().map(String::as_str));
    let mut b = Builder::new("projection", 1, &doc);
    let ty = Type::signed(spec.bits, 0);
    let vector = |b: &mut Builder, name: &str, bound| {
        COORDINATES.map(|c| interval::input(b, &format!("{name}_{c}"), ty, interval::symmetric(bound)))
    };
    let v = vector(&mut b, "v", spec.point);
    let l = vector(&mut b, "l", spec.axis);
    let mut factors = |name: &str, x: [Bounds; 3]| {
        [0, 1, 2].map(|i| {
            let name = format!("{name}_{}_sign_case", COORDINATES[i]);
            Factor { bounds: x[i], sign_case: b.input(&name, SIGN_CASE, SIGN_CASE.limits(), Rate::Any) }
        })
    };
    let (v, l) = (factors("v", v), factors("l", l));
    let select = (spec.roundings.len() > 1).then(|| {
        let ty = Type::unsigned(select_bits(spec.roundings.len()));
        b.input("rounding", ty, (0, spec.roundings.len() as i128 - 1), Rate::Any)
    });
    let multiply = multiply::multiply_unit("projection_multiply", (ty, spec.point), (ty, spec.axis));
    let wide = multiply.node(multiply.outputs[0].1).ty;
    let range = |terms: i128| interval::symmetric(terms * spec.point * spec.axis);
    let add_two = interval::add_unit("projection_add_two", (wide, range(1)), (wide, range(1)));
    let sum = add_two.node(add_two.outputs[0].1).ty;
    let add_three = interval::add_unit("projection_add_three", (sum, range(2)), (wide, range(1)));
    let products = [0, 1, 2].map(|i| {
        let name = format!("v_{0}_l_{0}", COORDINATES[i]);
        multiply::instance(&mut b, &name, &multiply, v[i], l[i])
    });
    let two = interval::instance(&mut b, "x_plus_y", &add_two, &products[..2], &[])[0];
    let three = interval::instance(&mut b, "x_plus_y_plus_z", &add_three, &[two, products[2]], &[])[0];
    let p = interval::round(&mut b, "p_rounded", three, spec.roundings, select, spec.upper, spec.bits);
    b.comment(p.lo, "lower bound of v * l");
    b.comment(p.hi, "upper bound of v * l");
    interval::output(&mut b, "p", p);
    b.finish()
}
