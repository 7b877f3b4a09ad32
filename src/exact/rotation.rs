//! Solid rotation about the middle of the domain, one turn a second, counterclockwise, and what it carries.
//!
//! `u = omega (-(y - y_m), x - x_m)`, `omega = 2 pi / s`. A field that does not diffuse turns with it; a Gaussian that does
//! spreads as in free space: `c = a^2 / (a^2 + 4 D t) exp(-r^2 / (a^2 + 4 D t))`, `r` from the centre that has turned.
//! Source: a solution of `dc/dt + u . grad c = D lap c`; it is the usual test of advection schemes.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::case::{Shape, Tracer};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation {
    /// m
    middle: DVec2,
}

impl Rotation {
    /// `size` of the domain, m.
    pub fn new(size: DVec2) -> Self {
        Self { middle: 0.5 * size }
    }

    /// m/s at a place, m.
    pub fn velocity(&self, place: DVec2) -> DVec2 {
        TAU * (place - self.middle).perp()
    }

    /// Where the fluid at a place was `time`, s, before.
    fn before(&self, place: DVec2, time: f64) -> DVec2 {
        self.middle + DVec2::from_angle(-TAU * time).rotate(place - self.middle)
    }

    /// `None` for a disc or a box that diffuses.
    pub fn tracer(&self, tracer: &Tracer, place: DVec2, time: f64) -> Option<f64> {
        let from = self.before(place, time);
        match (tracer.shape, tracer.radius) {
            (_, _) if tracer.diffusivity == 0.0 => Some(tracer.initially(from)),
            (Shape::Gaussian, Some(radius)) => {
                let (square, spread) = (radius * radius, radius * radius + 4.0 * tracer.diffusivity * time);
                let from = (from - DVec2::from(tracer.centre)).length_squared();
                Some(square / spread * (-from / spread).exp())
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gaussian_solves_the_equation_of_advection_and_diffusion() {
        let flow = Rotation::new(DVec2::ONE);
        let tracer = Tracer {
            name: "c".to_owned(),
            diffusivity: 0.003,
            shape: Shape::Gaussian,
            centre: [0.5, 0.75],
            radius: Some(0.1),
            size: None,
        };
        let (h, time) = (1e-4, 0.2);
        let value = |place: DVec2, time: f64| flow.tracer(&tracer, place, time).expect("a Gaussian");
        for k in 0..20 {
            let at = DVec2::new(0.05 * f64::from(k), 0.9 - 0.03 * f64::from(k));
            let c = |d: DVec2| value(at + d, time);
            let [x, y] = [DVec2::X * h, DVec2::Y * h];
            let slope = DVec2::new(c(x) - c(-x), c(y) - c(-y)) / (2.0 * h);
            let curvature = (c(x) + c(-x) + c(y) + c(-y) - 4.0 * c(DVec2::ZERO)) / (h * h);
            let change = (value(at, time + h) - value(at, time - h)) / (2.0 * h);
            let left = change + flow.velocity(at).dot(slope) - tracer.diffusivity * curvature;
            assert!(left.abs() < 1e-5, "at {at}: {left:e}");
        }
        assert!((value(DVec2::new(0.25, 0.5), 0.25) - 0.01 / 0.013).abs() < 1e-12, "a quarter turn");
    }
}
