//! The cross product of two interval vectors: one axis (equation 1).

use super::interval::{Factors, Vector};
use super::rounding::Roundings;
use efsat_hardware::entity;
use efsat_hardware::graph::{Signals, Vec3};

/// `l = e x f`: component i is `e_j f_k - e_k f_j`, exact, then rounded once if there are `roundings`. Twelve multipliers at
/// up to 18 bits.
pub fn cross_product<'l>(
    e: Factors<'l>,
    f: Factors<'l>,
    roundings: Option<&Roundings<'l>>,
    formats: &[String],
) -> Vector<'l> {
    let rounded = match roundings {
        Some(_) => "rounded outward once.",
        None => "not rounded; what axis_shift makes of it has the format and bound of the table.",
    };
    let component = format!("Component i is e_j f_k - e_k f_j, {rounded}");
    let mut doc = vec!["One separating axis, l = e x f in interval arithmetic (equation 1).", &component, ""];
    doc.extend(formats.iter().map(String::as_str));
    let rounding = roundings.and_then(|roundings| roundings.select);
    entity!("cross_product", &doc, (e, f, rounding) => {
        let e_j_f_k = Vec3::each(|i| e[i + 1] * f[i + 2]).named("e_j_f_k");
        let e_k_f_j = Vec3::each(|i| e[i + 2] * f[i + 1]).named("e_k_f_j");
        let exact = e_j_f_k - e_k_f_j;
        match roundings.map(|roundings| roundings.selected_by(rounding)) {
            Some(roundings) => exact.named("exact").map(|x| x.round_outward(&roundings)).named("l"),
            None => exact.named("l"),
        }
    })
}
