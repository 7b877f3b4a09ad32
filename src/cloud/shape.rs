//! The shapes of obstacles: how far a place is from one, and its area.

use glam::DVec2;

use super::figure::Figure;
use crate::case;

/// Places along either side of a shape's box that are looked at for its deepest one.
const SAMPLES: usize = 64;

/// A closed figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    Circle {
        centre: DVec2,
        radius: f64,
    },
    /// Corners, anticlockwise.
    Polygon(Vec<DVec2>),
    Figure(Figure),
}

impl Shape {
    pub fn of(obstacle: &case::Obstacle) -> Self {
        if let Some(parts) = &obstacle.parts {
            return Shape::Figure(Figure::new(parts));
        }
        match (&obstacle.circle, &obstacle.polygon) {
            (Some(circle), _) => Self::circle(circle),
            (None, corners) => Self::polygon(corners.as_deref().unwrap_or_default()),
        }
    }

    pub fn circle(circle: &case::Circle) -> Self {
        Shape::Circle { centre: DVec2::from_array(circle.centre), radius: circle.radius }
    }

    /// Of corners either way round.
    pub fn polygon(corners: &[[f64; 2]]) -> Self {
        let mut corners: Vec<DVec2> = corners.iter().map(|&corner| DVec2::from_array(corner)).collect();
        if doubled(&corners) < 0.0 {
            corners.reverse();
        }
        Shape::Polygon(corners)
    }

    /// Distance of a place from the outline, negative inside, m.
    pub fn distance(&self, place: DVec2) -> f64 {
        match self {
            Shape::Circle { centre, radius } => place.distance(*centre) - radius,
            Shape::Polygon(corners) => {
                let (mut nearest, mut inside) = (f64::INFINITY, false);
                for (from, to) in edges(corners) {
                    let (along, way) = (to - from, place - from);
                    let share = (way.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                    nearest = nearest.min((way - share * along).length());
                    // A ray to the right crosses the outline an odd number of times from inside.
                    let crosses = (from.y > place.y) != (to.y > place.y);
                    if crosses && place.x < from.x + along.x * (place.y - from.y) / along.y {
                        inside = !inside;
                    }
                }
                if inside { -nearest } else { nearest }
            }
            Shape::Figure(figure) => figure.distance(place),
        }
    }

    /// m^2
    pub fn area(&self) -> f64 {
        match self {
            Shape::Circle { radius, .. } => std::f64::consts::PI * radius * radius,
            Shape::Polygon(corners) => 0.5 * doubled(corners),
            Shape::Figure(figure) => figure.area(),
        }
    }

    /// About how deep its deepest place is, and where that is, m.
    pub fn deepest(&self) -> (f64, DVec2) {
        let (low, high) = match self {
            Shape::Circle { centre, radius } => return (*radius, *centre),
            Shape::Polygon(corners) => {
                let first = corners.first().copied().unwrap_or_default();
                corners.iter().fold((first, first), |(low, high), &corner| (low.min(corner), high.max(corner)))
            }
            Shape::Figure(figure) => figure.bounds(),
        };
        let place = |k: usize| {
            let share = DVec2::new((k % SAMPLES) as f64, (k / SAMPLES) as f64) + 0.5;
            low + share / SAMPLES as f64 * (high - low)
        };
        let depths = (0..SAMPLES * SAMPLES).map(|k| (-self.distance(place(k)), place(k)));
        depths.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, low))
    }
}

/// The edges of a polygon, each from corner to corner.
pub(super) fn edges(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]))
}

/// Twice the area of a polygon, m^2: negative where the corners run clockwise.
fn doubled(corners: &[DVec2]) -> f64 {
    edges(corners).map(|(from, to)| from.perp_dot(to)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 2]]) -> Shape {
        Shape::of(&case::Obstacle {
            name: "body".to_owned(),
            circle: None,
            polygon: Some(corners.to_vec()),
            parts: None,
        })
    }

    #[test]
    fn distances_are_negative_inside_and_corners_may_run_either_way() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
        let mut backwards = corners;
        backwards.reverse();
        for shape in [polygon(&corners), polygon(&backwards)] {
            assert!((shape.area() - 3.0).abs() < 1e-15);
            let root = 0.5_f64.sqrt();
            for (place, expected) in
                [([1.0, 0.25], -0.25), ([1.0, 2.0], root), ([-3.0, -4.0], 5.0), ([1.5, 1.0], -0.25 * 2.0 * root)]
            {
                let found = shape.distance(DVec2::from_array(place));
                assert!((found - expected).abs() < 1e-12, "{place:?}: {found}");
            }
        }
        let circle = Shape::Circle { centre: DVec2::ONE, radius: 0.5 };
        assert_eq!((circle.distance(DVec2::ONE), circle.distance(DVec2::new(3.0, 1.0))), (-0.5, 1.5));
    }
}
