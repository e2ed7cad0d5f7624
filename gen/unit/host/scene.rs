//! Two meshes under a pose: normalised once, posed per query, read per pair.

use std::borrow::Cow;

use super::boxes::Boxes;
use super::{Host, grid};
use crate::dyadic::Dyadic;
use crate::golden::{Golden, Numbers};
use crate::pair::{Input, Pair, Pose};
use crate::params::{Method, Params, Transform, Truth};
use efsat_geometry::finite::{self, NotFinite};
use efsat_geometry::software::retest::{retest, retest_posed};
use efsat_hardware::number::Interval;

/// Two meshes, each centred on the exact midpoint of its own box and both scaled by the largest power of two with
/// which they fit [-1, 1]^3, quantised to the input format.
#[derive(Clone, Debug)]
pub struct SceneHost {
    params: Params,
    vertices: [Vec<[f64; 3]>; 2],
    centres: [[Dyadic; 3]; 2],
    /// The scale is 2^power.
    power: i64,
    inputs: [Vec<[Input; 3]>; 2],
}

/// A scene under one pose: what the unit loads, and every pair by its vertex indices.
#[derive(Clone, Debug)]
pub struct ScenePose<'a> {
    /// The frame change of the unit; bypassed where the host has applied the pose itself.
    pub pose: Pose,
    a: &'a [[Input; 3]],
    b: Cow<'a, [[Input; 3]]>,
    outside: Outside<'a>,
    /// Of the exact unit with the frame transform.
    snapping: Option<Golden>,
}

/// Which pairs are outside the declared ranges.
#[derive(Clone, Debug)]
enum Outside<'a> {
    None,
    /// Those that use a marked vertex of B.
    Vertices(Vec<bool>, Boxes),
    /// All, because the pose itself is.
    All(Boxes),
    /// All, of the exact unit with the frame transform: they are decided as they are given.
    AsGiven(OffGrid<'a>),
    /// Those that do not fit the exact unit, each moved to its own V0 and put on its own grid.
    OffGrid(OffGrid<'a>),
}

/// A scene in one pose for the exact unit without the frame transform, which reads neither the pose nor the normalised meshes.
#[derive(Clone, Debug)]
struct OffGrid<'a> {
    host: &'a SceneHost,
    m: [[f64; 3]; 3],
    t: [f64; 3],
    /// The vertices of B in the frame of A.
    images: Vec<[Dyadic; 3]>,
}

impl OffGrid<'_> {
    fn pair(&self, a: [usize; 3], b: [usize; 3]) -> Host {
        let [v0, v1, v2] = a.map(|i| self.host.vertices[0][i].map(Dyadic::from));
        let [w0, w1, w2] = b.map(|i| self.images[i].clone());
        let pair = grid::pair(&Dyadic::together([v0, v1, v2, w0, w1, w2]), self.host.params.grid_bits());
        pair.map_or_else(|| self.decided(a, b), Host::Unit)
    }

    /// The answer of the host.
    fn decided(&self, a: [usize; 3], b: [usize; 3]) -> Host {
        let [of_a, of_b] = &self.host.vertices;
        let answer = retest_posed(&a.map(|i| of_a[i]), &b.map(|i| of_b[i]), &self.m, &self.t);
        Host::Decided(answer.expect("vertices and poses are finite").into())
    }
}

impl SceneHost {
    /// Normalises and quantises the vertices of the meshes A and B.
    ///
    /// # Errors
    /// If a coordinate is not finite.
    pub fn new(a: &[[f64; 3]], b: &[[f64; 3]], params: &Params) -> Result<Self, NotFinite> {
        finite::meshes(a, b)?;
        let boxes = [a, b].map(bounds);
        let centres = boxes.map(|mesh| mesh.map(|[low, high]| (Dyadic::from(low) + Dyadic::from(high)).scaled(-1)));
        let half = |[low, high]: [f64; 2]| (Dyadic::from(high) - Dyadic::from(low)).scaled(-1);
        let reach = boxes.into_iter().flatten().map(half).max().unwrap_or_else(Dyadic::zero);
        let power = if reach.is_zero() { 0 } else { -reach.ceil_log2() };
        let fraction = params.input().fraction as u32;
        let inputs = [0, 1].map(|side: usize| {
            let normalised = |vertex: &[f64; 3]| {
                [0, 1, 2].map(|i| {
                    (Dyadic::from(vertex[i]) - centres[side][i].clone())
                        .scaled(power)
                        .quantised(fraction, params.one())
                        .expect("a vertex lies in the box it was normalised by")
                })
            };
            [a, b][side].iter().map(normalised).collect()
        });
        Ok(Self { params: params.clone(), vertices: [a.to_vec(), b.to_vec()], centres, power, inputs })
    }

    /// The scene with B at M * x + t in the frame of A, x a vertex as given; `m` is indexed `[row][column]`.
    ///
    /// In normalised coordinates the translation becomes t' = s (M c_B + t - c_A), exactly. A unit that cannot do the
    /// pose (no transform, or a translation only) gets vertices of B to which it has been applied, exactly, before
    /// quantisation. The exact unit gets every pair as [`loose_pair`](super::loose_pair) makes it, after the pose, unless
    /// it has a transform that rounds: then it gets what the other units get.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn pose(&self, m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<ScenePose<'_>, NotFinite> {
        finite::pose(m, t)?;
        let motion = Motion { m: m.map(|row| row.map(Dyadic::from)), t: t.map(Dyadic::from) };
        let (way, shift) = self.way(m, &motion);
        let mut scene = ScenePose {
            pose: Pose::identity(&self.params),
            a: &self.inputs[0],
            b: Cow::Borrowed(&self.inputs[1]),
            outside: Outside::None,
            snapping: None,
        };
        let as_given = || OffGrid { host: self, m: *m, t: *t, images: self.images(&motion) };
        match (self.params.method, self.params.truth) {
            (Method::Exact, Truth::Given) => {
                scene.outside = Outside::OffGrid(as_given());
                return Ok(scene);
            }
            (Method::Exact, Truth::Snapped) => scene.snapping = Some(Golden::new(&self.params)),
            (Method::Axes | Method::Determinants, _) => {}
        }
        match way {
            Way::Host => return Ok(self.moved(&motion)),
            Way::None => {}
            Way::Unit => match self.quantised(&motion.m, &shift) {
                Some(pose) => scene.pose = pose,
                None if scene.snapping.take().is_some() => scene.outside = Outside::AsGiven(as_given()),
                None => scene.outside = Outside::All(self.boxes(&self.images(&motion))),
            },
        }
        Ok(scene)
    }

    /// Whether the unit answers for geometry that is snapped to a grid.
    pub fn snaps(&self) -> bool {
        self.params.truth == Truth::Snapped
    }

    /// How B gets into the frame of A, and t'.
    fn way(&self, m: &[[f64; 3]; 3], motion: &Motion) -> (Way, [Dyadic; 3]) {
        let unturned = (0..3).all(|i| (0..3).all(|j| m[i][j] == f64::from(i == j)));
        let shift = self.normalised(motion.apply(&self.centres[1]));
        let identity = unturned && shift.iter().all(Dyadic::is_zero);
        let way = match self.params.transform {
            _ if identity => Way::None,
            Transform::On => Way::Unit,
            Transform::Translate if unturned => Way::Unit,
            Transform::Translate | Transform::Off => Way::Host,
        };
        (way, shift)
    }

    /// The real numbers that stand behind the inputs of a pair of triangles with these vertices: [`pose`](Self::pose)
    /// without the quantisation.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn numbers(
        &self,
        m: &[[f64; 3]; 3],
        t: &[f64; 3],
        [a, b]: &[[[f64; 3]; 3]; 2],
    ) -> Result<Numbers<Dyadic>, NotFinite> {
        finite::pose(m, t)?;
        finite::pair(&[a[0], a[1], a[2], b[0], b[1], b[2]])?;
        let motion = Motion { m: m.map(|row| row.map(Dyadic::from)), t: t.map(Dyadic::from) };
        let (way, shift) = self.way(m, &motion);
        let fraction = self.params.input().fraction.into();
        let exact = |x: Dyadic| {
            let x = x.scaled(fraction);
            Interval::new(x.clone(), x)
        };
        let centred = |vertex: &[f64; 3], side: usize| {
            [0, 1, 2].map(|i| (Dyadic::from(vertex[i]) - self.centres[side][i].clone()).scaled(self.power))
        };
        let b = b.each_ref().map(|vertex| match way {
            Way::Host => self.normalised(motion.apply(&vertex.map(Dyadic::from))),
            Way::None | Way::Unit => centred(vertex, 1),
        });
        Ok(Numbers {
            a: a.each_ref().map(|vertex| centred(vertex, 0).map(exact)),
            b: b.map(|vertex| vertex.map(exact)),
            pose: matches!(way, Way::Unit).then(|| (motion.m.map(|row| row.map(exact)), shift.map(exact))),
        })
    }

    /// The pose as the unit reads it, if it is inside the declared ranges.
    fn quantised(&self, m: &[[Dyadic; 3]; 3], t: &[Dyadic; 3]) -> Option<Pose> {
        let fraction = self.params.input().fraction as u32;
        let mut pose = Pose::identity(&self.params);
        pose.bypass = false;
        for (to, entry) in pose.m.iter_mut().flatten().zip(m.iter().flatten()) {
            *to = entry.clone().quantised(fraction, self.params.one())?;
        }
        for (to, entry) in pose.t.iter_mut().zip(t) {
            *to = entry.clone().quantised(fraction, self.params.translation_bound())?;
        }
        Some(pose)
    }

    /// The scene with the pose applied to the vertices of B.
    fn moved(&self, motion: &Motion) -> ScenePose<'_> {
        let (fraction, bound) = (self.params.input().fraction as u32, self.params.coordinate_bound());
        let images = self.images(motion);
        let inputs: Vec<Option<[Input; 3]>> = images
            .iter()
            .cloned()
            .map(|vertex| {
                let [x, y, z] = self.normalised(vertex).map(|x| x.quantised(fraction, bound));
                Some([x?, y?, z?])
            })
            .collect();
        let marked: Vec<bool> = inputs.iter().map(Option::is_none).collect();
        let outside =
            if marked.contains(&true) { Outside::Vertices(marked, self.boxes(&images)) } else { Outside::None };
        ScenePose {
            pose: Pose::identity(&self.params),
            a: &self.inputs[0],
            b: inputs.into_iter().map(Option::unwrap_or_default).collect(),
            outside,
            snapping: None,
        }
    }

    /// s (x - c_A), for a point in the frame of A.
    fn normalised(&self, point: [Dyadic; 3]) -> [Dyadic; 3] {
        let [x, y, z] = &self.centres[0];
        let [p, q, r] = point;
        [p - x.clone(), q - y.clone(), r - z.clone()].map(|x| x.scaled(self.power))
    }

    /// The vertices of B in the frame of A.
    fn images(&self, motion: &Motion) -> Vec<[Dyadic; 3]> {
        self.vertices[1].iter().map(|vertex| motion.apply(&vertex.map(Dyadic::from))).collect()
    }

    fn boxes(&self, images: &[[Dyadic; 3]]) -> Boxes {
        let a: Vec<[Dyadic; 3]> = self.vertices[0].iter().map(|vertex| vertex.map(Dyadic::from)).collect();
        Boxes::new(&a, images)
    }
}

impl ScenePose<'_> {
    /// The pair of the triangles with these vertex indices.
    ///
    /// # Panics
    /// If an index is outside its mesh.
    pub fn pair(&self, a: [u32; 3], b: [u32; 3]) -> Host {
        let (a, b) = (a.map(|i| i as usize), b.map(|i| i as usize));
        match &self.outside {
            Outside::OffGrid(scene) => scene.pair(a, b),
            Outside::AsGiven(scene) => scene.decided(a, b),
            Outside::All(boxes) => Host::Decided(boxes.verdict(a, b)),
            Outside::Vertices(marked, boxes) if b.iter().any(|&i| marked[i]) => Host::Decided(boxes.verdict(a, b)),
            _ => match self.snap(a, b) {
                Some((points, false)) => Host::Decided(retest(&points).expect("whole numbers are finite").into()),
                _ => Host::Unit(self.read(a, b)),
            },
        }
    }

    /// The points for which the unit answers, if they are not those of the meshes: snapped to the grid behind the frame
    /// transform, relative to V0, in ulps of the input format.
    ///
    /// # Panics
    /// If an index is outside its mesh.
    pub fn snapped(&self, a: [u32; 3], b: [u32; 3]) -> Option<[[f64; 3]; 6]> {
        self.snap(a.map(|i| i as usize), b.map(|i| i as usize)).map(|(points, _)| points)
    }

    /// Those points, and whether they fit the unit.
    fn snap(&self, a: [usize; 3], b: [usize; 3]) -> Option<([[f64; 3]; 6], bool)> {
        let (points, fits) = self.snapping.as_ref()?.snapped(&self.pose, &self.read(a, b))?;
        // At most 50 bits.
        Some((points.map(|point| point.map(|x| x as f64)), fits))
    }

    fn read(&self, a: [usize; 3], b: [usize; 3]) -> Pair {
        Pair { a: a.map(|i| self.a[i]), b: b.map(|i| self.b[i]) }
    }
}

/// Who brings B into the frame of A.
enum Way {
    /// Nobody: it is there.
    None,
    Unit,
    Host,
}

/// x to M * x + t, exactly.
struct Motion {
    m: [[Dyadic; 3]; 3],
    t: [Dyadic; 3],
}

impl Motion {
    fn apply(&self, x: &[Dyadic; 3]) -> [Dyadic; 3] {
        [0, 1, 2].map(|i| (0..3).fold(self.t[i].clone(), |sum, j| sum + self.m[i][j].clone() * x[j].clone()))
    }
}

/// Least and greatest coordinate along each axis; zeros for a mesh without vertices.
fn bounds(mesh: &[[f64; 3]]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|axis| {
        let column = || mesh.iter().map(|vertex| vertex[axis]);
        [column().reduce(f64::min).unwrap_or(0.0), column().reduce(f64::max).unwrap_or(0.0)]
    })
}
