//! Places for labels: beside their points, and not over anything else.

/// A rectangle: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle(pub [f64; 4]);

impl Rectangle {
    fn overlaps(&self, other: &Self) -> bool {
        let ([l, t, r, b], [left, top, right, bottom]) = (self.0, other.0);
        l < right && left < r && t < bottom && top < b
    }

    fn within(&self, other: &Self) -> bool {
        let ([l, t, r, b], [left, top, right, bottom]) = (self.0, other.0);
        l >= left && t >= top && r <= right && b <= bottom
    }
}

/// What is drawn already.
pub struct Places {
    area: Rectangle,
    taken: Vec<Rectangle>,
}

impl Places {
    /// Nothing yet, in an area.
    pub fn new(area: Rectangle) -> Self {
        Self { area, taken: vec![] }
    }

    /// Something is there.
    pub fn take(&mut self, what: Rectangle) {
        self.taken.push(what);
    }

    /// A mark is there.
    pub fn mark(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.take(Rectangle([x - radius, y - radius, x + radius, y + radius]));
    }

    /// A rectangle of that size beside a point, which is taken then; none if there is no room.
    pub fn find(&mut self, [x, y]: [f64; 2], width: f64, height: f64) -> Option<Rectangle> {
        let mut candidates = vec![];
        for gap in [8.0, 12.0, 18.0, 26.0, 36.0, 48.0, 62.0, 80.0] {
            let (above, below, middle) = (y - gap - height, y + gap, y - height / 2.0);
            let (right, left, centre) = (x + gap, x - gap - width, x - width / 2.0);
            candidates.extend([(right, middle), (left, middle), (centre, above), (centre, below)]);
            candidates.extend([(right, above), (right, below), (left, above), (left, below)]);
        }
        let boxes = candidates.into_iter().map(|(l, t)| Rectangle([l, t, l + width, t + height]));
        let free = |r: &Rectangle| r.within(&self.area) && !self.taken.iter().any(|other| r.overlaps(other));
        let found = boxes.into_iter().find(free)?;
        self.take(found);
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_clear_of_each_other_and_of_the_edge() {
        let mut places = Places::new(Rectangle([0.0, 0.0, 100.0, 40.0]));
        let first = places.find([10.0, 20.0], 30.0, 10.0).unwrap();
        assert_eq!(first, Rectangle([18.0, 15.0, 48.0, 25.0]));
        let second = places.find([12.0, 20.0], 30.0, 10.0).unwrap();
        assert!(!second.overlaps(&first));
        assert_eq!(places.find([50.0, 20.0], 200.0, 10.0), None);
    }
}
