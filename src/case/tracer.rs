//! What a tracer begins with.

use glam::DVec2;

use super::{Shape, Tracer};

impl Tracer {
    /// Its value at a place, m, at the beginning.
    pub fn initially(&self, place: DVec2) -> f64 {
        let offset = place - DVec2::from(self.centre);
        let radius = self.radius.unwrap_or(0.0);
        let half = 0.5 * DVec2::from(self.size.unwrap_or([0.0, 0.0]));
        match self.shape {
            Shape::Gaussian => (-offset.length_squared() / (radius * radius)).exp(),
            Shape::Disc => f64::from(u8::from(offset.length() <= radius)),
            Shape::Box => f64::from(u8::from(offset.abs().cmple(half).all())),
        }
    }
}
