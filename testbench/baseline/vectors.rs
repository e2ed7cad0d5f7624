//! Vectors in the unit's own words, from integers alone: nothing here depends on a crate's random numbers or on rounding of
//! floating point, so that a seed names the same vectors for ever.

use efsat::pair::{Input, Pair, Pose};
use efsat::params::{Params, Transform, Upper};

/// A pose, and the pairs under it.
pub type Segment = (Pose, Vec<Pair>);

/// Pairs under one pose.
const SEGMENT: usize = 8;

type Point = [i64; 3];
type Triangle = [Point; 3];

/// The generator splitmix64.
pub struct Draw(pub u64);

impl Draw {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.word() % end as u64) as usize
    }

    /// True once in so many times.
    fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// Any number of [-reach, reach].
    fn within(&mut self, reach: i64) -> i64 {
        (self.word() % (2 * reach as u64 + 1)) as i64 - reach
    }

    /// A vector of any order of magnitude up to `reach`.
    fn small(&mut self, reach: i64) -> Point {
        let reach = reach >> self.below(reach.max(1).ilog2() as usize + 2);
        [(); 3].map(|()| self.within(reach))
    }

    /// A vector of a few ulps, often zero.
    fn few(&mut self) -> Point {
        let reach = self.one_of(&[0, 1, 3]);
        [(); 3].map(|()| self.within(reach))
    }

    /// Any number of a range, or with `corner` one where it is most likely to be handled wrongly.
    fn number(&mut self, bound: i64, corner: bool) -> Input {
        let any = self.within(bound);
        let corners = [bound, bound - 1, bound / 2, 1, 0, -1, -bound / 2, -bound + 1, -bound, any];
        let lo = if corner { self.one_of(&corners) } else { any };
        self.input(lo, bound)
    }

    /// The number with either sticky bit that it may have in [-bound, bound].
    fn input(&mut self, lo: i64, bound: i64) -> Input {
        Input { lo, sticky: lo < bound && self.once_in(2) }
    }

    /// A number just outside [-bound, bound], at an end of the word, or any word of the format at all.
    fn outside(&mut self, p: &Params, bound: i64) -> Input {
        let end = 1 << (p.transform_width - 1);
        let with_sticky = Input { lo: bound, sticky: true };
        let just_above = if p.upper == Upper::Sticky { with_sticky } else { Input::exact(bound + 1) };
        let any = Input { lo: self.within(end - 1), sticky: self.once_in(2) };
        self.one_of(&[just_above, Input::exact(-bound - 1), Input::exact(-end), Input::exact(end - 1), any])
    }

    /// A triangle of any size, often large, sometimes flat along a coordinate axis, thin, a segment or a point.
    fn triangle(&mut self, reach: i64) -> Triangle {
        let octaves = if self.once_in(3) { reach.ilog2() as usize } else { 2 };
        let size = reach >> self.below(octaves + 1);
        let at = [(); 3].map(|()| self.within(reach));
        let mut x = [(); 3].map(|()| plus(at, [(); 3].map(|()| self.within(size))).map(|c| c.clamp(-reach, reach)));
        match self.below(24) {
            0 => {
                let axis = self.below(3);
                (x[1][axis], x[2][axis]) = (x[0][axis], x[0][axis]);
            }
            1 | 2 => x[2] = plus(mixed(&x, self.within(512), 0), self.few()),
            3 => x[2] = x[1],
            4 if self.once_in(2) => x = [x[0]; 3],
            _ => {}
        }
        x
    }

    /// A point of a triangle: at a vertex, on an edge, inside.
    fn point_of(&mut self, x: &Triangle) -> Point {
        let [u, v] = [(); 2].map(|()| self.below(257) as i64);
        match self.below(3) {
            0 => x[self.below(3)],
            1 => mixed(x, u, 256 - u),
            _ => mixed(x, u, v * (256 - u) / 256),
        }
    }

    /// Two triangles with coordinates in [-reach, reach].
    fn triangles(&mut self, reach: i64) -> [Triangle; 2] {
        if self.once_in(10) {
            // On a coarse grid, so that narrow units can say something about them.
            let step = 1 << reach.ilog2();
            return [(); 2].map(|()| [(); 3].map(|()| [(); 3].map(|()| self.one_of(&[-step, 0, step]))));
        }
        let mut a = self.triangle(reach);
        let extent = a.iter().flat_map(|x| minus(*x, a[0])).map(i64::abs).max().unwrap_or(0).max(1);
        let size = ((extent << self.below(3)) >> 1).clamp(1, reach);
        let moved = |x: Triangle, by: Point| x.map(|point| plus(point, by));
        let mut b = moved(self.triangle(size), a[0]);
        match self.below(16) {
            // Anywhere: most are far apart.
            0 => b = self.triangle(reach),
            // As large as A, in its middle.
            1 | 2 => {
                let by = minus(mixed(&a, 85, 85), mixed(&b, 85, 85));
                b = moved(b, by);
            }
            // An edge of B goes through a point of A: they intersect, mostly for certain.
            3..=8 => {
                let middle = mixed(&a, 64 + self.within(32), 64 + self.within(32));
                let through = if self.once_in(4) { self.point_of(&a) } else { middle };
                let along = if self.once_in(4) { self.small(extent) } else { [(); 3].map(|()| self.within(extent)) };
                b = [plus(through, along), minus(through, along), plus(through, self.small(extent))];
            }
            // A point of B a gap away from a point of A.
            9..=11 => {
                let (from, to) = (self.point_of(&b), self.point_of(&a));
                b = moved(b, plus(minus(to, from), self.small(extent)));
            }
            // A point of B at a point of A, or a few ulps off.
            12 => {
                let (from, to) = (self.point_of(&b), self.point_of(&a));
                b = moved(b, plus(minus(to, from), self.few()));
            }
            // One vertex of B close to the plane of A, or all: coplanar but for a few ulps.
            13 if self.once_in(2) => {
                let count = self.one_of(&[1, 3]);
                for point in &mut b[..count] {
                    *point = plus(mixed(&a, self.within(512), self.within(512)), self.few());
                }
            }
            // In one coordinate plane, often side by side.
            13 => {
                b = moved(b, [(); 3].map(|()| self.within(2 * extent)));
                let (axis, height) = (self.below(3), self.within(reach));
                a.iter_mut().chain(&mut b).for_each(|point| point[axis] = height);
            }
            // One or two vertices are shared, or nearly so.
            14 => {
                let count = self.one_of(&[1, 2]);
                for point in &mut b[..count] {
                    *point = plus(a[self.below(3)], self.few());
                }
            }
            // Parallel, or nearly so.
            _ => {
                let by = self.small(extent);
                b = a.map(|point| plus(plus(point, by), self.few()));
            }
        }
        let mut both = [a, b];
        for x in &mut both {
            x.rotate_left(self.below(3));
        }
        both.rotate_left(self.below(2));
        both.map(|x| x.map(|point| point.map(|c| c.clamp(-reach, reach))))
    }

    /// A pair inside the declared ranges, in the relation that was drawn where B is in the frame of A.
    fn pair(&mut self, p: &Params, frame: &Frame) -> Pair {
        let bound = p.coordinate_bound() as i64;
        let kind = self.below(20);
        if kind < 3 {
            let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| self.number(bound, kind > 0)));
            return Pair { a: triangle(), b: triangle() };
        }
        // A turn takes the corners of the range out of it, and so does a translation.
        let [a, b] = self.triangles(if frame.still() { bound } else { bound * 5 / 8 });
        let sticky = self.once_in(2);
        let mut quantised = |x: Triangle| {
            x.map(|point| {
                point.map(|c| {
                    let mut input = self.input(c.clamp(-bound, bound), bound);
                    input.sticky &= sticky;
                    input
                })
            })
        };
        Pair { a: quantised(a), b: quantised(b.map(|point| frame.back(point))) }
    }

    /// A pose inside the declared ranges, and what it does as far as pairs are to follow it.
    fn pose(&mut self, p: &Params) -> (Pose, Frame) {
        let identity = Frame { turn: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], whole: 1, t: [0; 3] };
        let mut pose = Pose::identity(p);
        if p.transform == Transform::Off {
            return (pose, identity);
        }
        let (one, far) = (p.one() as i64, p.translation_bound() as i64);
        let kind = self.below(8);
        if kind < 2 {
            // With the bypass no number of the pose is read.
            let corner = self.once_in(2);
            pose = Pose {
                m: [(); 3].map(|()| [(); 3].map(|()| self.number(one, corner))),
                t: [(); 3].map(|()| self.number(far, corner)),
                bypass: kind == 0,
            };
            return (pose, identity);
        }
        pose.bypass = false;
        let quaternion = match kind {
            2 => self.one_of(&[[1, 0, 0, 0], [0, 1, 0, 0], [1, 0, 0, 1], [1, 1, 1, 1]]),
            // A small turn.
            3 => [255, self.within(3), self.within(3), self.within(3)],
            _ => [1 + self.within(9).abs(), self.within(9), self.within(9), self.within(9)],
        };
        let mut frame = if p.transform == Transform::On { Frame::turn(quaternion) } else { identity };
        let reach = if self.once_in(8) { far } else { one >> (2 + self.below(8)) };
        frame.t = [(); 3].map(|()| self.within(reach));
        if p.transform == Transform::On {
            pose.m = frame.turn.map(|row| row.map(|entry| frame.entry(entry, one)));
        }
        pose.t = frame.t.map(|t| self.input(t, far));
        (pose, frame)
    }

    /// Takes some of the numbers out of their declared ranges.
    fn leave_ranges(&mut self, p: &Params, (pose, pairs): &mut Segment) {
        let (coordinate, one, far) = (p.coordinate_bound(), p.one(), p.translation_bound());
        if self.once_in(6) {
            let entries = if p.transform == Transform::On { pose.m.as_flattened_mut() } else { &mut [] };
            let numbers = entries.iter_mut().map(|x| (x, one)).chain(pose.t.iter_mut().map(|x| (x, far)));
            let mut numbers: Vec<_> = numbers.collect();
            let (number, bound) = numbers.swap_remove(self.below(numbers.len()));
            *number = self.outside(p, bound as i64);
        }
        for pair in pairs {
            while self.once_in(5) {
                let triangle = if self.once_in(2) { &mut pair.a } else { &mut pair.b };
                triangle[self.below(3)][self.below(3)] = self.outside(p, coordinate as i64);
            }
        }
    }
}

/// B = turn / whole * B~ + t, on integers.
struct Frame {
    turn: [[i64; 3]; 3],
    whole: i64,
    t: Point,
}

impl Frame {
    /// The turn of an integer quaternion.
    fn turn([w, x, y, z]: [i64; 4]) -> Self {
        let turn = [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ];
        Self { turn, whole: w * w + x * x + y * y + z * z, t: [0; 3] }
    }

    fn still(&self) -> bool {
        self.turn[0][0] == self.whole && self.turn[1][1] == self.whole && self.t == [0; 3]
    }

    /// An entry of the turn as the unit reads it.
    fn entry(&self, entry: i64, one: i64) -> Input {
        let (exact, whole) = (i128::from(entry) * i128::from(one), i128::from(self.whole));
        Input { lo: exact.div_euclid(whole) as i64, sticky: exact.rem_euclid(whole) != 0 }
    }

    /// The point that comes to `b`.
    fn back(&self, b: Point) -> Point {
        let moved = minus(b, self.t);
        let sum = |j: usize| (0..3).map(|i| i128::from(self.turn[i][j]) * i128::from(moved[i])).sum::<i128>();
        [0, 1, 2].map(|j| sum(j).div_euclid(i128::from(self.whole)) as i64)
    }
}

fn plus(x: Point, y: Point) -> Point {
    [0, 1, 2].map(|i| x[i] + y[i])
}

fn minus(x: Point, y: Point) -> Point {
    [0, 1, 2].map(|i| x[i] - y[i])
}

/// x0 + u/256 (x1 - x0) + v/256 (x2 - x0), rounded.
fn mixed(x: &Triangle, u: i64, v: i64) -> Point {
    [0, 1, 2].map(|i| x[0][i] + (((x[1][i] - x[0][i]) * u + (x[2][i] - x[0][i]) * v) >> 8))
}

/// `count` pairs in segments under one pose each, for the unit of a parameter set; where it has a guard some numbers are
/// outside the declared ranges.
pub fn segments(p: &Params, count: usize, seed: u64) -> Vec<Segment> {
    let mut draw = Draw(seed);
    let segment = |start: usize| {
        let (pose, frame) = draw.pose(p);
        let pairs = (start..count.min(start + SEGMENT)).map(|_| draw.pair(p, &frame)).collect();
        let mut segment = (pose, pairs);
        if p.guarded() {
            draw.leave_ranges(p, &mut segment);
        }
        segment
    };
    (0..count).step_by(SEGMENT).map(segment).collect()
}
