//! The projection of one point on an axis: an interval dot product (equation 2).

use super::interval::{Factors, Interval};
use super::rounding::Roundings;
use crate::params::{Params, ProjectionWidth};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};

/// `p = v . l = (v_x l_x + v_y l_y) + v_z l_z`, exact, then rounded once. Six multipliers at up to 18 bits.
pub fn projection<'l>(
    p: &Params,
    v: Factors<'l>,
    l: Factors<'l>,
    roundings: &Roundings<'l>,
    formats: &[String],
) -> Interval<Sig<'l>> {
    let width = match p.projection_width {
        ProjectionWidth::Rounded => "exact, then rounded outward once.",
        ProjectionWidth::Plus(_) => "exact, then both bounds rounded down, which comparisons allow.",
        ProjectionWidth::Full => "exact.",
    };
    let sum = format!("(v_x l_x + v_y l_y) + v_z l_z, {width}");
    let mut doc = vec!["Projection of one point on the axis, p = v . l in interval arithmetic (equation 2).", &sum, ""];
    doc.extend(formats.iter().map(String::as_str));
    let rounding = roundings.select;
    entity!("projection", &doc, (v, l, rounding) => {
        let term = Vec3::each(|i| v[i] * l[i]).named("term");
        let exact = ((term[0] + term[1]).named("xy") + term[2]).named("exact");
        exact.round_outward(&roundings.selected_by(rounding)).named("p")
    })
}
