//! From the scene to the picture.

use super::{HEIGHT, WIDTH};
use nalgebra::{Point3, Vector3};

/// Steps of light, so that triangles of one colour can be put together.
const LIGHTS: f64 = 6.0;

/// A rectangle, in pixels of the picture or before scaling: the least and the greatest coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Frame {
    /// The least one around points before scaling.
    pub fn around<'a>(points: impl Iterator<Item = &'a Point3<f64>>) -> Self {
        let empty = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        points.fold(empty, |frame, point| {
            let at = projected(point);
            Self {
                low: [0, 1].map(|axis| frame.low[axis].min(at[axis])),
                high: [0, 1].map(|axis| frame.high[axis].max(at[axis])),
            }
        })
    }

    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    /// A square around its middle, so many times as wide as its longer side, and not narrower than `least`.
    pub fn square(&self, times: f64, least: f64) -> Self {
        let half = 0.5 * (times * self.size()[0].max(self.size()[1])).max(least);
        let middle = [0, 1].map(|axis| self.low[axis] * 0.5 + self.high[axis] * 0.5);
        Self { low: middle.map(|x| x - half), high: middle.map(|x| x + half) }
    }
}

/// The isometric projection, scaled to a part of the picture.
pub(super) struct View {
    scale: f64,
    offset: [f64; 2],
}

/// A triangle in the picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Item {
    /// Corners: to the right, downwards, towards the eye.
    pub corners: [[f64; 3]; 3],
    pub colour: [u8; 3],
}

impl Item {
    /// How near it is.
    pub fn depth(&self) -> f64 {
        self.corners.iter().map(|corner| corner[2]).sum()
    }

    /// Calls `visit` with every pixel of a window whose centre it covers, and the depth there.
    pub fn pixels(&self, window: &Frame, mut visit: impl FnMut(usize, f64)) {
        let [p, q, r] = self.corners;
        let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let span = |axis: usize, end: usize| {
            let (low, high) = (p[axis].min(q[axis]).min(r[axis]), p[axis].max(q[axis]).max(r[axis]));
            let (low, high) = (low.max(window.low[axis]), high.min(window.high[axis]));
            // A negative number becomes 0.
            (low - 0.5).ceil() as usize..end.min((high + 0.5).max(0.0) as usize + 1)
        };
        for y in span(1, HEIGHT) {
            for x in span(0, WIDTH) {
                let (u, v) = (x as f64 + 0.5, y as f64 + 0.5);
                let weight = |s: [f64; 3], t: [f64; 3]| ((s[0] - u) * (t[1] - v) - (s[1] - v) * (t[0] - u)) / area;
                let weights = [weight(q, r), weight(r, p), weight(p, q)];
                if weights.iter().all(|weight| *weight >= 0.0) {
                    let depth = weights.iter().zip([p, q, r]).map(|(weight, corner)| weight * corner[2]).sum();
                    visit(y * WIDTH + x, depth);
                }
            }
        }
    }
}

/// The directions to the right, downwards and towards the eye.
fn axes() -> [Vector3<f64>; 3] {
    let [two, three, six] = [2.0f64, 3.0, 6.0].map(f64::sqrt);
    [Vector3::new(-1.0, 1.0, 0.0) / two, Vector3::new(1.0, 1.0, -2.0) / six, Vector3::new(1.0, 1.0, 1.0) / three]
}

/// Where a point is before scaling.
fn projected(point: &Point3<f64>) -> [f64; 3] {
    axes().map(|axis| axis.dot(&point.coords))
}

impl View {
    /// Scales so that a frame before scaling fits into a window of the picture.
    pub fn new(shown: &Frame, window: &Frame) -> Self {
        let [size, room] = [shown, window].map(Frame::size);
        let fits = |axis: usize| room[axis] / size[axis].max(f64::MIN_POSITIVE);
        let scale = fits(0).min(fits(1));
        let middle = |frame: &Frame, axis: usize| frame.low[axis] * 0.5 + frame.high[axis] * 0.5;
        Self { scale, offset: [0, 1].map(|axis| middle(window, axis) - scale * middle(shown, axis)) }
    }

    /// A point of the scene: to the right, downwards, towards the eye.
    pub fn point(&self, point: &Point3<f64>) -> [f64; 3] {
        let [x, y, z] = projected(point);
        [self.offset[0] + self.scale * x, self.offset[1] + self.scale * y, self.scale * z]
    }

    /// A frame before scaling, in the picture.
    pub fn frame(&self, frame: &Frame) -> Frame {
        let at = |corner: [f64; 2]| [0, 1].map(|axis| self.offset[axis] + self.scale * corner[axis]);
        Frame { low: at(frame.low), high: at(frame.high) }
    }

    /// A triangle; the colour follows from the light on it, which is at most 1.
    pub fn item(&self, corners: &[Point3<f64>; 3], colour: impl Fn(f64) -> [u8; 3]) -> Item {
        let [p, q, r] = corners;
        let normal = (q - p).cross(&(r - p));
        let length = normal.norm();
        // Either side is lit: faces may be turned.
        let lit = Vector3::new(0.3, 0.5, 0.81).dot(&normal).abs() / if length > 0.0 { length } else { 1.0 };
        let light = 0.62 + 0.38 * (lit * LIGHTS).round().min(LIGHTS) / LIGHTS;
        Item { corners: corners.each_ref().map(|corner| self.point(corner)), colour: colour(light) }
    }
}

/// For every pixel of a window the item that is nearest to the eye, by its number.
pub(super) fn buffer(items: &[Item], window: &Frame) -> Vec<Option<usize>> {
    let mut nearest = vec![(f64::NEG_INFINITY, None); WIDTH * HEIGHT];
    for (number, item) in items.iter().enumerate() {
        item.pixels(window, |pixel, depth| {
            if depth > nearest[pixel].0 {
                nearest[pixel] = (depth, Some(number));
            }
        });
    }
    nearest.into_iter().map(|(_, number)| number).collect()
}

/// The items that are seen in some pixel of a window, the farthest first.
pub(super) fn seen(items: &[Item], window: &Frame) -> Vec<Item> {
    let mut flags = vec![false; items.len()];
    buffer(items, window).into_iter().flatten().for_each(|number| flags[number] = true);
    let mut seen: Vec<Item> = items.iter().zip(flags).filter(|(_, seen)| *seen).map(|(item, _)| item.clone()).collect();
    seen.sort_by(|x, y| x.depth().total_cmp(&y.depth()));
    seen
}
