//! Exact products from hardware multipliers.

use crate::params::Params;
use efsat_hardware::device::{self, MULTIPLIER_BITS, SHORTEST_PRODUCT};
use efsat_hardware::entity;
use efsat_hardware::graph::{Fact, Sig, Signals};
use efsat_hardware::op::Type;

/// The multipliers of the part that a design is for.
pub(super) fn multiplier(p: &Params) -> [u32; 2] {
    device::find(&p.device).map_or([MULTIPLIER_BITS; 2], |device| device.multiplier)
}

/// An exact product: one hardware multiplier, or where an operand is too wide for it, partial products of unsigned parts
/// of a bit less and one signed top part.
pub fn product<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    // One entity serves all binary points.
    let fraction = x.ty().fraction.zip(y.ty().fraction).map(|(x, y)| x + y);
    mantissas(x.at_point(None), y.at_point(None)).at_point(fraction)
}

fn mantissas<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    let bits = [x.ty().bits, y.ty().bits];
    let name = format!("multiply_{}_{}", bits[0], bits[1]);
    let [wide, narrow] = x.block().multiplier();
    // Either operand may be the wider one.
    let count = |of: [u32; 2]| parts_of(bits[0], of[0]) * parts_of(bits[1], of[1]);
    let of = if count([narrow, wide]) < count([wide, narrow]) { [narrow, wide] } else { [wide, narrow] };
    if count(of) == 1 {
        let doc = [
            "p = x * y with its register, in an entity of its own, so that synthesis merges the two (Xilinx AR 13182).",
        ];
        return entity!(&name, &doc, (x, y) => (x * y).named("p"));
    }
    let cut = match of.map(|bits| bits - 1) {
        [x, y] if x == y => format!("The operands are cut into parts of {x} unsigned bits and a signed top part;"),
        [x, y] => format!("x is cut into parts of {x} unsigned bits, y of {y}, each with a signed top part;"),
    };
    let doc = [
        &format!("p = x * y, exact, from partial products. {cut}")[..],
        "each two parts have a multiplier, except two short top parts, which are multiplied in look-up tables. Partial",
        "products that do not overlap are concatenated instead of added.",
    ];
    entity!(&name, &doc, (x, y) => wide_product(x, y, of).named("p"))
}

/// How many parts there are of so many bits, each for a multiplier's operand.
fn parts_of(bits: u32, of: u32) -> u32 {
    1 + bits.saturating_sub(of).div_ceil(of - 1)
}

fn wide_product<'l>(x: Sig<'l>, y: Sig<'l>, of: [u32; 2]) -> Sig<'l> {
    let (xs, ys) = (parts(x, of[0]), parts(y, of[1]));
    let (last_x, last_y) = (xs.len() - 1, ys.len() - 1);
    // Bits of a part that is not the topmost, less the sign that it has not.
    let [part_x, part_y] = of.map(|bits| bits - 1);
    let mut diagonals: Vec<(u32, Sig<'l>)> = vec![];
    for diagonal in -(last_y as i32)..=last_x as i32 {
        let places = (0..=last_x).filter_map(|i| Some((i, usize::try_from(i as i32 - diagonal).ok()?)));
        let places: Vec<(usize, usize)> = places.filter(|(_, j)| *j <= last_y).collect();
        let part = |(i, j): &(usize, usize)| {
            let [a, b] = [xs[*i], ys[*j]];
            let tiny = a.ty().bits + b.ty().bits < SHORTEST_PRODUCT;
            let [a, b] = if tiny { [a, b] } else { [a.resize(factor(of[0])), b.resize(factor(of[1]))] };
            let part = product(a, b).named(&format!("part_{i}{j}"));
            // Only the topmost part may be negative; the others are products of unsigned parts.
            let bits =
                |bits: u32, part: u32, k: usize, last: usize| if k < last { part } else { bits - part * last as u32 };
            let bits = bits(x.ty().bits, part_x, *i, last_x) + bits(y.ty().bits, part_y, *j, last_y);
            part.resize(Type { signed: *i == last_x || *j == last_y, bits, fraction: None })
        };
        let all: Vec<Sig<'l>> = places.iter().map(part).collect();
        let (i, j) = places[0];
        diagonals.push((i as u32 * part_x + j as u32 * part_y, all[0].below(&all[1..])));
    }
    // From the highest place down: the low bits of a diagonal pass by the adders.
    diagonals.sort_by_key(|(place, _)| std::cmp::Reverse(*place));
    let (mut at, mut sum) = diagonals[0];
    for (place, diagonal) in &diagonals[1..] {
        let below = at - place;
        sum = match below {
            0 => *diagonal + sum,
            _ => {
                let diagonal = diagonal.named(&format!("diagonal_{place}"));
                diagonal.low(below).below(&[(diagonal.floor(below as i32) + sum).named(&format!("above_{place}"))])
            }
        };
        at = *place;
    }
    sum.known(Fact::Product, &[x, y]).bits(x.ty().bits + y.ty().bits)
}

/// An operand of a multiplier.
fn factor(bits: u32) -> Type {
    Type { signed: true, bits, fraction: None }
}

/// The parts of a factor, the lowest first, none wider than a multiplier takes.
fn parts(x: Sig<'_>, of: u32) -> Vec<Sig<'_>> {
    if x.ty().bits <= of {
        return vec![x];
    }
    let mut all = vec![x.low(of - 1).resize(factor(of))];
    all.extend(parts(x.floor(of as i32 - 1), of));
    all
}
