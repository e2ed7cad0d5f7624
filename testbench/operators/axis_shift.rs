//! Axes that are shifted before they are rounded.

use super::{Bench, UPPERS, at, rounded, tuples, vector};
use efsat::design::axis_shift::axis_shift;
use efsat::graph::Signals;
use efsat::op::Type;
use efsat::params::Params;

/// Bits of the components.
const N: u32 = 5;

#[test]
fn shifted_axes_contain_every_exact_one() {
    // Near the powers of two, where the number of leading zeros changes, and beyond what rounding can tell from them.
    let most = 2 * 15 * 15;
    let powers = (0..9).flat_map(|p| [(1 << p) - 1, 1 << p, (1 << p) + 1]).filter(|x| *x <= most);
    let ends: Vec<i128> = powers.flat_map(|x| [x, -x]).chain([0, most, -most]).collect();
    let mut intervals: Vec<_> = ends.iter().map(|x| at(*x, *x)).collect();
    intervals.extend(ends.iter().map(|x| at((*x - 9).max(-most), *x)));
    let few: Vec<_> = intervals.iter().step_by(5).copied().collect();
    for (upper, shift) in UPPERS.into_iter().flat_map(|upper| [1, 2, 30].map(|shift| (upper, shift))) {
        let p = Params { width: N, axis_shift: shift, upper, ..Params::default() };
        let mut unit = Bench::new(|top| axis_shift(&p, vector(top, "exact", Type::signed(2 * N, 0), most)).signals());
        let mut shifts = [0; N as usize];
        let mut check = |x: &[_]| {
            let found = unit.bounds(x, &[]);
            let unshifted = x.iter().map(|x| rounded(*x, N as i32, upper));
            let greatest = unshifted.flat_map(|x| [x.lo.abs(), x.hi.abs()]).max().unwrap();
            let left = (0..=p.axis_positions()).rev().find(|s| greatest << s < 1 << (N - 1)).unwrap();
            shifts[left as usize] += 1;
            for (x, found) in x.iter().zip(found) {
                let x = at(x.lo << left, x.hi << left);
                assert_eq!(found, rounded(x, N as i32, upper), "{x:?} by {left}");
                assert!(found.lo << N <= x.lo && x.hi <= found.hi << N, "{x:?}");
                assert!(found.lo.abs() < 1 << (N - 1) && found.hi.abs() < 1 << (N - 1), "{found:?}");
            }
        };
        tuples(&few, 3, &mut check);
        intervals.iter().for_each(|x| check(&[*x, at(0, 0), at(-1, 1)]));
        assert!(shifts[..=p.axis_positions() as usize].iter().all(|count| *count > 0), "{shifts:?}");
    }
}
