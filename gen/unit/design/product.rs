//! Exact products from hardware multipliers.

use efsat_hardware::device::{MULTIPLIER_BITS, SHORTEST_PRODUCT};
use efsat_hardware::entity;
use efsat_hardware::graph::{Fact, Sig, Signals};
use efsat_hardware::op::Type;

/// Bits that a partial product takes of an operand: a multiplier's width less the sign.
const PART: u32 = MULTIPLIER_BITS - 1;
const FACTOR: Type = Type { signed: true, bits: MULTIPLIER_BITS, fraction: None };

/// An exact product: one hardware multiplier, or where an operand is too wide for it, partial products of parts of 17
/// unsigned bits and one signed top part.
pub fn product<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    // One entity serves all binary points.
    let fraction = x.ty().fraction.zip(y.ty().fraction).map(|(x, y)| x + y);
    mantissas(x.at_point(None), y.at_point(None)).at_point(fraction)
}

fn mantissas<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    let name = format!("multiply_{}_{}", x.ty().bits, y.ty().bits);
    if x.ty().bits <= MULTIPLIER_BITS && y.ty().bits <= MULTIPLIER_BITS {
        let doc = [
            "p = x * y with its register, in an entity of its own, so that synthesis merges the two (Xilinx AR 13182).",
        ];
        return entity!(&name, &doc, (x, y) => (x * y).named("p"));
    }
    let doc = [
        "p = x * y, exact, from partial products. The operands are cut into parts of 17 unsigned bits and a signed top part;",
        "each two parts have a multiplier, except two short top parts, which are multiplied in look-up tables. Partial",
        "products that do not overlap are concatenated instead of added.",
    ];
    entity!(&name, &doc, (x, y) => wide(x, y).named("p"))
}

fn wide<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    let (xs, ys) = (parts(x), parts(y));
    let (last_x, last_y) = (xs.len() - 1, ys.len() - 1);
    let mut diagonals: Vec<(u32, Sig<'l>)> = vec![];
    for diagonal in -(last_y as i32)..=last_x as i32 {
        let places = (0..=last_x).filter_map(|i| Some((i, usize::try_from(i as i32 - diagonal).ok()?)));
        let places: Vec<(usize, usize)> = places.filter(|(_, j)| *j <= last_y).collect();
        let part = |(i, j): &(usize, usize)| {
            let [a, b] = [xs[*i], ys[*j]];
            let tiny = a.ty().bits + b.ty().bits < SHORTEST_PRODUCT;
            let [a, b] = if tiny { [a, b] } else { [a, b].map(|x| x.resize(FACTOR)) };
            let part = product(a, b).named(&format!("part_{i}{j}"));
            // Only the topmost part may be negative; the others are products of unsigned parts.
            let bits = |bits: u32, k: usize, last: usize| if k < last { PART } else { bits - PART * last as u32 };
            let bits = bits(x.ty().bits, *i, last_x) + bits(y.ty().bits, *j, last_y);
            part.resize(Type { signed: *i == last_x || *j == last_y, bits, fraction: None })
        };
        let all: Vec<Sig<'l>> = places.iter().map(part).collect();
        let (i, j) = places[0];
        diagonals.push(((i + j) as u32 * PART, all[0].below(&all[1..])));
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

/// The parts of a factor, the lowest first, none wider than a multiplier takes.
fn parts(x: Sig<'_>) -> Vec<Sig<'_>> {
    if x.ty().bits <= MULTIPLIER_BITS {
        return vec![x];
    }
    let mut all = vec![x.low(PART).resize(FACTOR)];
    all.extend(parts(x.floor(PART as i32)));
    all
}
