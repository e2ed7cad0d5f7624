//! One row of the frame transform, B = M * B~ + t (section 3 of the contract).

use super::interval::{self, Bounds, Rounding};
use super::multiply::{self, Span};
use crate::params::{Params, Transform};
use efsat_hardware::graph::{Builder, NodeId, Op, Rate, Type, Unit};
use efsat_hardware::number::Upper;
use std::rc::Rc;

/// The type of an input number.
pub fn input_type(p: &Params) -> Type {
    let format = p.input();
    Type::signed(format.bits, format.fraction)
}

/// A number as it comes from the host: lower bound and, with [`Upper::Sticky`], the sticky bit.
#[derive(Clone, Copy, Debug)]
pub struct Quantised {
    /// Lower bound.
    pub lo: NodeId,
    /// Sticky bit, none with [`Upper::Implied`].
    pub sticky: Option<NodeId>,
    /// Bound on the true magnitude, where the number always is within it.
    pub bound: Option<i128>,
}

impl Quantised {
    /// Ports for one number.
    pub fn input(b: &mut Builder, name: &str, p: &Params, bound: i128, rate: Rate) -> Self {
        let lo = b.input(name, input_type(p), interval::symmetric(bound), rate);
        let sticky = (p.upper == Upper::Sticky).then(|| b.input(&format!("{name}_sticky"), Type::FLAG, (0, 1), rate));
        Self { lo, sticky, bound: Some(bound) }
    }

    /// Ports for one number of which any word may come: nothing is known of it.
    pub fn word(b: &mut Builder, name: &str, p: &Params, rate: Rate) -> Self {
        let ty = input_type(p);
        let lo = b.input(name, ty, ty.limits(), rate);
        let sticky = (p.upper == Upper::Sticky).then(|| b.input(&format!("{name}_sticky"), Type::FLAG, (0, 1), rate));
        Self { lo, sticky, bound: None }
    }

    /// Flag: the upper bound is one ulp above the lower; not so where `exact` is set.
    fn is_inexact(self, b: &mut Builder, name: &str, exact: Option<NodeId>) -> NodeId {
        match (self.sticky, exact) {
            (Some(sticky), _) => sticky,
            (None, None) => b.constant(&format!("{name}_inexact"), 1, Type::FLAG),
            (None, Some(exact)) => b.op(&format!("{name}_inexact"), Op::Not, &[exact]),
        }
    }

    /// The interval: the upper bound is one ulp above the lower, or a sticky bit; exact where `exact` is set.
    pub fn bounds(self, b: &mut Builder, name: &str, p: &Params, exact: Option<NodeId>) -> Bounds {
        let ty = b.ty(self.lo);
        let inexact = self.is_inexact(b, name, exact);
        let ulp = b.op(&format!("{name}_ulp"), Op::Reinterpret(ty.fraction), &[inexact]);
        let mut above = b.add(&format!("{name}_above"), self.lo, ulp);
        if let (Some(bound), Some(_)) = (self.bound, self.sticky) {
            // The ceiling of a number within the bound is within it too.
            above = b.op(&format!("{name}_declared"), Op::Assert((-bound, bound), "declared-range"), &[above]);
        }
        let hi = b.resize(&format!("{name}_hi"), above, true, ty.bits);
        let rule = if p.upper == Upper::Sticky { "floor + sticky bit" } else { "floor + ulp (equation 5)" };
        b.comment(hi, rule);
        Bounds { lo: self.lo, hi }
    }

    /// The nodes that carry the number through a choice.
    pub fn nodes(self) -> impl Iterator<Item = NodeId> {
        std::iter::once(self.lo).chain(self.sticky)
    }
}

/// The row unit: with [`Transform::On`] `m0 x0 + m1 x1 + m2 x2 + t`, with [`Transform::Translate`] `x0 + t`.
///
/// `bypass` makes matrix and translation exact; the pose registers then hold the identity, so the row returns its
/// coordinate bit for bit.
pub fn unit(p: &Params) -> Rc<Unit> {
    let terms = if p.transform == Transform::On { 3 } else { 1 };
    let ty = input_type(p);
    let doc: &[&str] = if terms == 3 {
        &[
            "One row of the frame transform, b = m0 x0 + m1 x1 + m2 x2 + t (section 3 of the contract), in interval",
            "arithmetic at full width, then rounded outward once. With bypass m and t are exact: the row is an identity.",
        ]
    } else {
        &["One row of the frame transform, b = x0 + t (a pure translation), exact in interval arithmetic."]
    };
    let mut b = Builder::new("transform_row", 1, doc);
    let bound = |b: i128| b + i128::from(p.upper == Upper::Implied);
    let (one, coordinate, translation) = (bound(p.one()), bound(p.coordinate_bound()), bound(p.translation_bound()));
    let port = |b: &mut Builder, name: &str, bound| Quantised::input(b, name, p, bound, Rate::Any);
    let m: Vec<Quantised> =
        (0..if terms == 3 { 3 } else { 0 }).map(|j| port(&mut b, &format!("m{j}"), p.one())).collect();
    let x: Vec<Quantised> = (0..terms).map(|j| port(&mut b, &format!("x{j}"), p.coordinate_bound())).collect();
    let t = port(&mut b, "t", p.translation_bound());
    let bypass = b.input("bypass", Type::FLAG, (0, 1), Rate::Any);
    let t = t.bounds(&mut b, "t", p, Some(bypass));
    if terms == 1 {
        let add = interval::add_unit(
            "translate_add",
            (ty, interval::symmetric(coordinate)),
            (ty, interval::symmetric(translation)),
        );
        let x = x[0].bounds(&mut b, "x0", p, None);
        let sum = interval::instance(&mut b, "x0_plus_t", &add, &[x, t], &[])[0];
        let lo = b.resize("b_lo_bits", sum.lo, true, ty.bits);
        let hi = b.resize("b_hi_bits", sum.hi, true, ty.bits);
        interval::output(&mut b, "b", Bounds { lo, hi });
        return b.finish();
    }
    let span = |lo, hi| Span { ty, lo, hi };
    let multiply = multiply::quantised_multiply_unit(
        "transform_multiply",
        span(p.one(), one),
        span(p.coordinate_bound(), coordinate),
    );
    let wide = multiply.node(multiply.outputs[0].1).ty;
    let product = one * coordinate;
    let fraction = ty.fraction;
    let add_two = interval::add_unit(
        "transform_add_two",
        (wide, interval::symmetric(product)),
        (wide, interval::symmetric(product)),
    );
    let two = add_two.node(add_two.outputs[0].1).ty;
    // The translation is appended zeros to line up with the products.
    let t = Bounds {
        lo: b.op("t_lo_aligned", Op::Append(fraction as u32), &[t.lo]),
        hi: b.op("t_hi_aligned", Op::Append(fraction as u32), &[t.hi]),
    };
    let aligned = b.ty(t.lo);
    let t_range = interval::symmetric(translation << fraction);
    let add_t = interval::add_unit("transform_add_t", (wide, interval::symmetric(product)), (aligned, t_range));
    let with_t = add_t.node(add_t.outputs[0].1).ty;
    let add_all = interval::add_unit(
        "transform_add_all",
        (two, interval::symmetric(2 * product)),
        (with_t, interval::symmetric(product + (translation << fraction))),
    );
    let products: Vec<Bounds> = (0..3)
        .map(|j| {
            let m_ulp = m[j].is_inexact(&mut b, &format!("m{j}"), Some(bypass));
            let x_ulp = x[j].is_inexact(&mut b, &format!("x{j}"), None);
            interval::instance(&mut b, &format!("m{j}_x{j}"), &multiply, &[], &[m[j].lo, m_ulp, x[j].lo, x_ulp])[0]
        })
        .collect();
    let left = interval::instance(&mut b, "sum_01", &add_two, &products[..2], &[])[0];
    let right = interval::instance(&mut b, "sum_2t", &add_t, &[products[2], t], &[])[0];
    let sum = interval::instance(&mut b, "sum", &add_all, &[left, right], &[])[0];
    let result = match p.upper {
        Upper::Sticky => {
            let way = Rounding { drop: fraction, clamp: None };
            interval::round(&mut b, "b_rounded", sum, &[way], None, p.upper, ty.bits)
        }
        // With bypass nothing is rounded, and no ulp may be added.
        Upper::Implied => {
            let lo = b.op("b_floor_lo", Op::Floor(fraction as u32), &[sum.lo]);
            let floor = b.op("b_floor_hi", Op::Floor(fraction as u32), &[sum.hi]);
            let hi = Quantised { lo: floor, sticky: None, bound: None }.bounds(&mut b, "b_up", p, Some(bypass)).hi;
            Bounds { lo: b.resize("b_lo_bits", lo, true, ty.bits), hi: b.resize("b_hi_bits", hi, true, ty.bits) }
        }
    };
    interval::output(&mut b, "b", result);
    b.finish()
}
