//! Offsets and places in a rectangle that repeats, on the host. A period of 0 is none.

use glam::DVec2;

/// The offset between two points of the rectangle, the shortest way round, m.
pub fn shortest(offset: DVec2, period: DVec2) -> DVec2 {
    let along = |d: f64, period: f64| {
        let beyond = if d > 0.5 * period { period } else { 0.0 };
        let short = if d < -0.5 * period { period } else { 0.0 };
        d - beyond + short
    };
    DVec2::new(along(offset.x, period.x), along(offset.y, period.y))
}

/// A place, wherever it is, brought back into `[0, period)`, m.
pub fn inside(place: DVec2, period: DVec2) -> DVec2 {
    let along = |x: f64, period: f64| {
        if period <= 0.0 {
            return x;
        }
        let within = x - period * (x / period).floor();
        // What is less than a rounding unit below 0 comes out as the period itself.
        if within < period { within } else { 0.0 }
    };
    DVec2::new(along(place.x, period.x), along(place.y, period.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: DVec2 = DVec2::new(2.0, 0.0);

    #[test]
    fn the_shortest_way_crosses_the_seam_along_a_period_and_nowhere_else() {
        for (offset, expected) in [(0.3, 0.3), (-0.9, -0.9), (1.6, -0.4), (-1.9, 0.1)] {
            let found = shortest(DVec2::new(offset, offset), PERIOD);
            assert!((found.x - expected).abs() < 1e-15 && found.y == offset, "{found}");
        }
    }

    #[test]
    fn places_come_back_from_any_distance() {
        for (place, expected) in [(0.5, 0.5), (-0.25, 1.75), (2.0, 0.0), (7.5, 1.5), (-6.5, 1.5), (-1e-300, 0.0)] {
            let found = inside(DVec2::new(place, place), PERIOD);
            assert_eq!(found, DVec2::new(expected, place));
        }
    }
}
