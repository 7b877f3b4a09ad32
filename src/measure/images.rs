//! Points of a domain that repeats, with copies of those near its seams on the other side: what looks around a place then
//! needs to know of no seam.

use std::borrow::Cow;

use glam::DVec2;

/// Points and their copies.
#[derive(Debug, Clone)]
pub struct Images<'a> {
    /// Places, m: of the points, in their order, then of the copies.
    pub position: Cow<'a, [DVec2]>,
    /// Number of points.
    points: usize,
    /// Whose copies those are.
    source: Vec<usize>,
}

impl<'a> Images<'a> {
    /// Copies what stands within `reach`, m, of a seam. `period` is the domain's length, m, along an axis that repeats, 0 along
    /// another; a copy stands one period away, and places in `[0, period]` are looked around.
    pub fn new(position: &'a [DVec2], period: DVec2, reach: f64) -> Self {
        let (mut copies, mut source) = (Vec::new(), Vec::new());
        let shifts = |length: f64| if length > 0.0 { vec![0.0, -length, length] } else { vec![0.0] };
        for y in shifts(period.y) {
            for x in shifts(period.x) {
                let shift = DVec2::new(x, y);
                if shift == DVec2::ZERO {
                    continue;
                }
                for (point, &place) in position.iter().enumerate() {
                    let copy = place + shift;
                    let near = |x: f64, length: f64| length == 0.0 || (-reach..=length + reach).contains(&x);
                    if near(copy.x, period.x) && near(copy.y, period.y) {
                        copies.push(copy);
                        source.push(point);
                    }
                }
            }
        }
        let points = position.len();
        let position = match copies.is_empty() {
            true => Cow::Borrowed(position),
            false => Cow::Owned(position.iter().copied().chain(copies).collect()),
        };
        Self { position, points, source }
    }

    /// Number of points, copies apart.
    pub fn points(&self) -> usize {
        self.points
    }

    /// The point that an entry of `position` is or is a copy of.
    pub fn point(&self, entry: usize) -> usize {
        if entry < self.points { entry } else { self.source[entry - self.points] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_near_a_seam_have_copies_across_it_and_corners_three() {
        let cloud = [DVec2::new(0.5, 0.5), DVec2::new(0.05, 0.5), DVec2::new(0.95, 0.02)];
        let count =
            |images: &Images, point: usize| (0..images.position.len()).filter(|&k| images.point(k) == point).count();
        let both = Images::new(&cloud, DVec2::ONE, 0.1);
        assert_eq!([0, 1, 2].map(|point| count(&both, point)), [1, 2, 4]);
        assert!(both.position.contains(&DVec2::new(1.05, 0.5)) && both.points() == 3);
        let along_x = Images::new(&cloud, DVec2::X, 0.1);
        assert_eq!([0, 1, 2].map(|point| count(&along_x, point)), [1, 2, 2]);
        assert_eq!(Images::new(&cloud, DVec2::ZERO, 0.1).position.len(), 3);
    }
}
