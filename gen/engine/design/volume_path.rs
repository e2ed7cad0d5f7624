//! The data path of an expansion: two blocks, four tests of two volumes.

use super::align::align;
use super::direction_test::direction_test;
use super::fitted;
use super::origin_row::origin_row;
use super::row_sum::{ceiling, row_sum};
use super::select_code::select_code;
use crate::format::{EngineFormat, Width};
use crate::words::BlockLayout;
use efsat_hardware::graph::{self, Library, Phases, Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;
use efsat_hardware::record;
use efsat_unit::parts::{any, shared};
use std::rc::Rc;

/// What stands before the names of all entities, so that they can stand beside those of the triangle unit.
pub const PREFIX: &str = "volume_";

record! {
    /// How B reaches in a direction of A: three codes with their factors, and what that may miss. In the opposite direction it is
    /// the codes of the opposite directions.
    Row "row" {
        /// Which code of its slot each term reads.
        choice: [S; 3],
        /// Factors, in counts of 2^-(factor bits - 1).
        factor: [S; 3],
        /// In the same counts of a code's step.
        rest: S,
    }
}

/// The query of an expansion.
struct Query<'l> {
    pose: [Vec3<Sig<'l>>; 3],
    shift: Vec3<Sig<'l>>,
    error: Vec3<Sig<'l>>,
    rows: Vec<Row<Sig<'l>>>,
}

impl<'l> Query<'l> {
    fn new(u: Top<'l>, format: &EngineFormat) -> Self {
        let widths = format.widths();
        let signed = |width: Width| u.input(number(width), (-i128::from(width.bound), width.bound.into()));
        let count = |bits: u32| u.input(Type::unsigned(bits), (0, (1 << bits) - 1));
        let slots = format.directions.slots();
        let row = |_| Row {
            choice: slots.map(|slot| u.input(Type::unsigned(format.choice_bits()), (0, slot.len() as i128 - 1))),
            factor: slots.map(|_| count(format.factor_bits)),
            rest: count(format.rest_bits()),
        };
        Self {
            pose: [(); 3].map(|()| Vec3::each(|_| signed(widths.origin))).named("query_pose"),
            shift: Vec3::each(|_| signed(widths.translation)).named("query_shift"),
            error: Vec3::each(|_| count(format.shift_error_bits())).named("query_error"),
            rows: (0..format.rows()).map(row).collect::<Vec<_>>().named("query_row"),
        }
    }
}

/// The type of a number of the test.
fn number(width: Width) -> Type {
    Type { signed: true, bits: width.bits(), fraction: width.fraction.map(|fraction| fraction as i32) }
}

/// The volumes of the children of a node, and which of them take part.
struct Block<'l> {
    origin: Vec3<Sig<'l>>,
    exponent: Sig<'l>,
    /// Of the left child and of the right one, by direction.
    codes: [Vec<Sig<'l>>; 2],
    take: [Sig<'l>; 2],
}

impl<'l> Block<'l> {
    fn new(u: Top<'l>, format: &EngineFormat, name: &str) -> Self {
        let most = i128::from(format.most());
        let code = |_| u.input(Type { signed: true, bits: format.offset_bits, fraction: None }, (-most, most));
        // No host writes the least origin there may be, but no check refuses it either.
        let origin = number(format.widths().origin);
        let coordinate = |_| u.input(origin, origin.limits());
        let exponent = Type::unsigned(BlockLayout::EXPONENT_BITS);
        Self {
            origin: Vec3::each(coordinate).named(&format!("{name}_origin")),
            exponent: u.input(exponent, exponent.limits()).named(&format!("{name}_exponent")),
            codes: [(); 2].map(|()| (0..format.k()).map(code).collect()).named(&format!("{name}_code")),
            take: [(); 2].map(|()| u.input(Type::FLAG, (0, 1))).named(&format!("{name}_take")),
        }
    }
}

/// Units whose tests in a phase are captured as one flag.
const UNITS_TOGETHER: usize = 3;

/// A direction of A and a child of B.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Job {
    direction: usize,
    child: usize,
}

/// The data path. Its inputs are the query and two blocks, held for the slot; its output is `survive`, bit 2 p + q: child p
/// of A and child q of B may overlap.
pub fn unit(format: &EngineFormat, clocks: usize) -> Rc<graph::Block> {
    let doc = [
        "The data path of an expansion: D, then in each direction h of A the bound of D, B's codes through the row of h, A's",
        "code of the opposite direction, and the test. Units are shared over the phases of the slot. A value captured for the",
        "expansion is named after what it is; later copies end in _h<clocks>, or are elements of x_held.",
    ];
    Library::with_prefix(PREFIX).block("path", &doc, clocks, |u| {
        let query = Query::new(u, format);
        let (a, b) = (Block::new(u, format, "a"), Block::new(u, format, "b"));
        let apart = apart(u, format, &query, &a, &b);
        let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)];
        pairs.map(|(i, j)| (a.take[i] & b.take[j]) & !apart[i][j]).named("survive")
    })
}

/// In the direction of each axis and in the opposite one, an upper bound of what D is in reals: D + error, error - D.
fn ends<'l>(u: Top<'l>, format: &EngineFormat, query: &Query<'l>, a: &Block<'l>, b: &Block<'l>) -> Vec3<[Sig<'l>; 2]> {
    let rows: Vec<_> = (0..3).map(|i| ((query.pose[i], query.shift[i]), a.origin[i])).collect();
    let d = shared(u, "d", &rows, |k, ((m, t), o_a)| origin_row(m, t, b.origin, o_a).named_at("d_lane", k));
    let ends = |i: usize| {
        let error = query.error[i].resize(number(format.widths().translation));
        [error + d[i], error - d[i]].map(fitted)
    };
    Vec3::each(ends).named("axis_bound")
}

/// Whether some direction has child q of B apart from child p of A, as \[p\]\[q\].
fn apart<'l>(u: Top<'l>, format: &EngineFormat, query: &Query<'l>, a: &Block<'l>, b: &Block<'l>) -> [[Sig<'l>; 2]; 2] {
    let clocks = u.interval();
    // All units work on one child of B in a phase; with a single phase every other unit does.
    let jobs = |unit: usize| {
        Phases::new(clocks, |s| {
            let job = unit * clocks + s;
            Some(Job { direction: job / 2, child: job % 2 })
        })
    };
    let groups = 2usize.div_ceil(clocks);
    // A unit that works on two directions works on opposite ones: with the second opposite codes and the ends change places.
    let of_unit = clocks.div_ceil(2);
    let doc = ["D, and what it reaches at most in the directions that units begin with."];
    let bounds = u.section("bounds", &doc, || {
        let ends = ends(u, format, query, a, b);
        let ends = match of_unit {
            1 => ends,
            _ => jobs(0).map(|job| ends.map(|[x, y]| if job.direction == 0 { [x, y] } else { [y, x] })).mux(),
        };
        // B_h, an upper bound of h . D in reals.
        let bound = |first: usize| {
            let axes = (0..3).zip(format.directions.vector(first)).filter(|(_, entry)| *entry != 0);
            let sum = axes.map(|(axis, entry)| ends[axis][usize::from(entry < 0)]).reduce(|x, y| x + y);
            sum.expect("a direction is not 0").bits(format.widths().base.bits())
        };
        (0..format.directions.count()).step_by(of_unit).map(bound).collect::<Vec<_>>().named("bound")
    });
    let (units, grid) = (2 * format.directions.count() / clocks, format.grid_fraction() as i32);
    let doc = ["How far B reaches in each direction: its codes through the row."];
    let reaches = u.section("rows", &doc, || {
        let codes =
            |job: &Job| (0..b.codes[0].len()).map(|j| b.codes[job.child][j ^ (job.direction & 1)]).collect::<Vec<_>>();
        let codes = (0..groups).map(|group| jobs(group).map(codes).mux()).collect::<Vec<_>>().named("b_chosen");
        let drop = format.factor_fraction();
        let ceiling = ceiling(b.exponent, drop).named("ceiling");
        let reach = |unit: usize| {
            let first = unit * clocks / 2;
            let (row, codes) = (query.rows[first / 2], &codes[unit % groups]);
            let code = |slot: usize| {
                let all: Vec<Sig<'l>> =
                    format.directions.slots()[slot].iter().map(|j| codes[usize::from(*j) ^ (first & 1)]).collect();
                select_code(&all, row.choice[slot]).named_at(&format!("term{slot}"), unit)
            };
            let s = row_sum([0, 1, 2].map(code), row.factor, row.rest, ceiling).named_at("s", unit);
            align("sum", s, b.exponent, drop as i32, grid)
        };
        (0..units).map(reach).collect::<Vec<_>>().named("u")
    });
    let doc = ["The test in each direction, with A's code of the opposite one."];
    u.section("tests", &doc, || {
        let mut found: [[Vec<Sig<'l>>; 2]; 2] = Default::default();
        for group in 0..groups {
            let test = |unit: usize| {
                let v = |i: usize| {
                    let code = jobs(unit).map(|job| a.codes[i][job.direction ^ 1]).mux();
                    align("code", code, a.exponent, 0, grid)
                };
                let v = [0, 1].map(v).named_at("v", unit);
                let bound = bounds[unit * clocks / 2 / of_unit];
                direction_test(format.widths().gap.bits(), bound, reaches[unit], v).named_at("apart", unit)
            };
            let tested: Vec<[Sig<'l>; 2]> = (group..units).step_by(groups).map(test).collect();
            // Not all units in one clock: they lie far apart.
            for (part, tested) in tested.chunks(UNITS_TOGETHER).enumerate() {
                let apart = [0, 1].map(|i| any(&tested.iter().map(|apart| apart[i]).collect::<Vec<_>>()));
                let apart = apart.named_at("apart_in_phase", part * groups + group);
                for (job, apart) in jobs(group).capture(&apart) {
                    (0..2).for_each(|i| found[i][job.child].push(apart[i]));
                }
            }
        }
        found.map(|of_a| of_a.map(|flags| any(&flags))).named("apart_found")
    })
}
