//! Numbers within their formats, and units whose parts are told apart.

use super::*;

/// Formats of section 4: coordinates and rounded moments have N bits, determinants 2 N + 3.
#[test]
fn numbers_keep_to_their_formats() {
    let mut rng = ChaCha8Rng::seed_from_u64(20);
    let fits = |x: i128, bits: u32| -(1 << (bits - 1)) <= x && x < 1 << (bits - 1);
    for _ in 0..800 {
        let p = params(&mut rng, 32, 48);
        let (pose, pair) = any(&mut rng, &p);
        for (name, x) in Golden::new(&p).trace(&pose, &pair) {
            let bits = match name.split('.').next().unwrap() {
                "difference" => p.transform_width + 1,
                "coordinate" | "moment" => p.width,
                "exact" => 2 * p.width,
                "dot" => 2 * p.width + 1,
                "determinant" => 2 * p.width + 3,
                _ => continue,
            };
            assert!(x.lo == x.hi && fits(x.lo, bits), "{name} = {} in {bits} bits: {p:?}", x.lo);
            assert!(!name.starts_with("coordinate") || x.lo.abs() < 1 << (p.width - 1));
        }
    }
}

/// Section 3: the shift is the least that is allowed, found by trying all.
#[test]
fn shifts_are_the_least_that_fit() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    for _ in 0..20_000 {
        let p = params(&mut rng, 32, 48);
        let reach = 1i64 << rng.random_range(0..=p.transform_width);
        // Next to powers of two, too, where rounding carries.
        let near = |rng: &mut ChaCha8Rng| match rng.random_range(0..3) {
            0 => within(rng, reach - 1),
            _ => (reach >> rng.random_range(0..4)) * [-1, 1][rng.random_range(0..2)] + within(rng, 2),
        };
        let mut vector = || [(); 3].map(|()| near(&mut rng).clamp(1 - reach, reach - 1));
        let points = Points { v: [vector(), vector()], w: [vector(), vector(), vector()] };
        let (fine, least) = match (p.transform, p.levels) {
            (Transform::On, levels) => (6, 6 - levels.min(6)),
            (Transform::Translate, levels) => (4, 4 - levels.min(4)),
            (Transform::Off, 0) => (3, 3),
            (Transform::Off, _) => (3, 0),
        };
        let coordinates = Scaling::new(&p).coordinates(&points);
        let mut level = 0;
        for j in 0..3 {
            let fits = |d: &u32| points.along(j).iter().all(|&x| round(x, *d).abs() < 1 << (p.width - 1));
            let d = (least..64).find(fits).unwrap();
            assert_eq!(coordinates.dropped[j], d, "{p:?} {points:?}");
            let most = if p.transform == Transform::Off { 2 } else { fine };
            level = level.max(fine.max(d) - d).min(most);
            assert!(d <= least.max(p.transform_width + 2 - p.width));
        }
        assert_eq!(coordinates.level, level);
        assert!(level <= p.levels);
        let rounded = |j: usize| points.along(j).map(|x| round(x, coordinates.dropped[j]));
        assert_eq!(coordinates.points, Points::new([0, 1, 2].map(rounded)));
    }
}

/// Section 4: the shift of the moments.
#[test]
fn moments_fill_their_format() {
    let mut rng = ChaCha8Rng::seed_from_u64(22);
    for _ in 0..5000 {
        let p = params(&mut rng, 32, 48);
        let reach = (1i64 << rng.random_range(0..p.width)) - 1;
        let mut vector = || [(); 3].map(|()| within(&mut rng, reach));
        let moments = Moments::new(&Points { v: [vector(), vector()], w: [vector(), vector(), vector()] });
        let (rounded, shift) = Rounding::new(&p).apply(&moments);
        let fits = |s: u32| {
            let end = 1 << (p.width - 1);
            moments.m.iter().flatten().chain(&moments.n).all(|&x| (-end..end).contains(&round(x, s)))
        };
        assert_eq!(Some(shift), (p.width - p.span..=p.width).find(|&s| fits(s)));
        assert_eq!(rounded.n, moments.n.map(|x| round(x, shift)));
        assert_eq!(rounded.m, moments.m.map(|m| m.map(|x| round(x, shift))));
    }
}

/// Section 2: a row as the hardware forms it, from high and low parts.
#[test]
fn rows_are_sums_of_partial_products() {
    let mut rng = ChaCha8Rng::seed_from_u64(23);
    for _ in 0..4000 {
        let p = Params { transform: Transform::On, levels: 6, ..params(&mut rng, 12, 48) };
        let f = p.transform_width - p.int_bits;
        let q = (f + 3).saturating_sub(18);
        let (pose, pair) = (sample::corner_pose(&mut rng, &p), sample::corner_pair(&mut rng, &p));
        let differences = Differences::new(&p);
        let points = differences.points(&differences.frame(&pose), &pair);
        for (l, i) in (0..9).map(|n| (n / 3, n % 3)) {
            let mut sum = if 2 * q <= f && q > 0 { 3i128 << (2 * q - 1) } else { 0 };
            for j in 0..3 {
                let [x, y] = [pose.m[i][j], pair.b[l][j]].map(|x| i128::from(2 * x.lo + 1));
                let ([x1, y1], [x0, y0]) = ([x >> q, y >> q], [x & ((1 << q) - 1), y & ((1 << q) - 1)]);
                assert!((-(1 << 17)..1 << 17).contains(&x1) && (-(1 << 17)..1 << 17).contains(&y1) || q == 0);
                sum += ((x1 * y1) << (2 * q)) + ((x1 * y0 + x0 * y1) << q);
                sum += if 2 * q <= f { 0 } else { x0 * y0 };
            }
            let row = ((sum + (1 << (f + 1))) >> (f + 2)) as i64;
            let moved = if pose.bypass { pair.b[l][i].lo } else { row + pose.t[i].lo };
            assert_eq!(points.w[l][i], moved - pair.a[0][i].lo, "{p:?}");
        }
    }
}

/// A guarded unit answers pairs outside the declared ranges so, whatever they are.
#[test]
fn the_guard_is_that_of_the_axis_unit() {
    let mut rng = ChaCha8Rng::seed_from_u64(25);
    for transform in [Transform::On, Transform::Translate, Transform::Off] {
        let p = Params { method: Method::Determinants, guard: Guard::Always, transform, ..Params::default() };
        let golden = Golden::new(&p);
        for number in 0..18 {
            for how in sample::Outside::ALL {
                let pose = sample::random_pose(&mut rng, &p);
                let pair = sample::random_pair_under(&mut rng, &p, &pose);
                let pair = sample::pair_outside(&mut rng, &p, pair, number, how);
                let outcome = golden.outcome(&pose, &pair);
                assert!(outcome.outside && outcome.verdict == Verdict::PossiblyIncorrect);
                assert_eq!((outcome.separated, outcome.overlapping), (0, 0));
                assert_eq!(golden.verdict(&pose, &pair), Verdict::PossiblyIncorrect);
                assert_eq!(golden.trace(&pose, &pair).len(), 128);
            }
        }
    }
}

/// By hand: a needle through a triangle, the same beside it, and a vertex on its face.
#[test]
fn plain_pairs() {
    let p = Params { method: Method::Determinants, transform: Transform::Off, ..Params::default() };
    let golden = Golden::new(&p);
    let pair = |b: [[i64; 3]; 3]| {
        let at = |x: [[i64; 3]; 3]| x.map(|x| x.map(|x| Input::exact(x << 20)));
        Pair { a: at([[0, 0, 0], [8, 0, 0], [0, 8, 0]]), b: at(b) }
    };
    let outcome = |b| golden.outcome(&Pose::identity(&p), &pair(b));
    let through = outcome([[2, 2, -4], [2, 3, 4], [3, 2, 4]]);
    // The two long edges of B pierce A, and none of A reaches B.
    assert_eq!((through.verdict, through.overlapping >> 3), (Verdict::Intersect, 0b101_000));
    let beside = outcome([[6, 6, -4], [6, 7, 4], [7, 6, 4]]);
    assert_eq!((beside.verdict, beside.separated & 0b111), (Verdict::Separate, 0b100));
    let above = outcome([[2, 2, 1], [2, 3, 4], [3, 2, 4]]);
    assert_eq!((above.verdict, above.separated & 0b111), (Verdict::Separate, 0b011));
    assert_eq!(outcome([[2, 2, 0], [2, 3, 4], [3, 2, 4]]).verdict, Verdict::PossiblyIncorrect);
    let coplanar = outcome([[1, 1, 0], [2, 1, 0], [1, 2, 0]]);
    assert_eq!((coplanar.verdict, coplanar.separated, coplanar.overlapping), (Verdict::PossiblyIncorrect, 0, 0));
}
