//! The points as CSV.

use super::results::Results;
use std::collections::BTreeSet;

/// All points as CSV: every option, every count, every figure.
pub fn csv(results: &Results) -> String {
    // Not every point has every option.
    let names: BTreeSet<&String> = results.rows.iter().flat_map(|row| row.point.options.keys()).collect();
    let figures = "pairs,separate,intersect,possibly_incorrect,possibly_incorrect_share,bound_low,bound_high,\
        undecided_separate,undecided_touch,undecided_intersect,undecided_coplanar,wrong,host_decided,multipliers,luts,\
        flip_flops,fits,synthesised_multipliers,synthesised_luts,synthesised_flip_flops,clock_mhz,interval,latency,\
        million_pairs_per_second,hardware_ns,retest_and_transfer_ns,effective_ns,best_for_time,best_for_multipliers";
    let mut text = names.iter().map(|name| format!("{},", name.replace('-', "_"))).collect::<String>() + figures + "\n";
    for row in &results.rows {
        let (point, a, h) = (&row.point, &row.point.answers, &row.point.hardware);
        names.iter().for_each(|name| text.push_str(&format!("{},", point.option(name))));
        let [low, high] = row.possibly_incorrect.bounds;
        let (u, c) = (a.undecided, h.cells);
        let synthesised =
            point.synthesised.map_or(",,".to_owned(), |c| format!("{},{},{}", c.multipliers, c.luts, c.flip_flops));
        text.push_str(&format!(
            "{},{},{},{},{},{low},{high},{},{},{},{},{},{},{},{},{},{},{synthesised},{},{},{},{},{},{},{},{},{}\n",
            a.pairs,
            a.verdicts.separate,
            a.verdicts.intersect,
            a.verdicts.possibly_incorrect,
            row.possibly_incorrect.share,
            u.truths.separate,
            u.truths.touch,
            u.truths.intersect,
            u.coplanar,
            a.wrong,
            a.host_decided,
            c.multipliers,
            c.luts,
            c.flip_flops,
            h.fits,
            h.clock,
            h.interval,
            h.latency,
            row.million_pairs_per_second,
            row.hardware_ns,
            row.cost_ns,
            row.effective_ns,
            row.best_for_time,
            row.best_for_multipliers,
        ));
    }
    text
}
