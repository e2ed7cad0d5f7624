//! The cross product of two interval vectors: one axis (equation 1).

use super::axis_shift::axis_shift;
use super::interval::{Factors, Vector};
use super::rounding::Roundings;
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Signals, Vec3};

/// `l = e x f`: component i is `e_j f_k - e_k f_j`, exact, then rounded once. Twelve multipliers at up to 18 bits.
pub fn cross_product<'l>(
    p: &Params,
    e: Factors<'l>,
    f: Factors<'l>,
    roundings: &Roundings<'l>,
    formats: &[String],
) -> Vector<'l> {
    let shifts = p.axis_shift > 0;
    let rounded = if shifts { "unit axis_shift rounds it" } else { "then rounded outward once" };
    let component = format!("Component i is e_j f_k - e_k f_j, exact; {rounded}.");
    let mut doc = vec!["One separating axis, l = e x f in interval arithmetic (equation 1).", &component, ""];
    doc.extend(formats.iter().map(String::as_str));
    let rounding = roundings.select.filter(|_| !shifts);
    let l = entity!("cross_product", &doc, (e, f, rounding) => {
        let e_j_f_k = Vec3::each(|i| e[i + 1] * f[i + 2]).named("e_j_f_k");
        let e_k_f_j = Vec3::each(|i| e[i + 2] * f[i + 1]).named("e_k_f_j");
        let exact = e_j_f_k - e_k_f_j;
        if shifts {
            exact.named("l")
        } else {
            let roundings = roundings.selected_by(rounding);
            exact.named("exact").map(|x| x.round_outward(&roundings)).named("l")
        }
    });
    if shifts { axis_shift(p, l.named("axis_exact")) } else { l }
}
