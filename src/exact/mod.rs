//! Flows that are known at every place and time: where a run begins, what its walls prescribe, what it is measured against.

mod kovasznay;
mod rotation;
mod slab;
mod taylor_green;

use glam::DVec2;

use crate::case::{Case, Solution, Tracer};
use kovasznay::Kovasznay;
use rotation::Rotation;
use slab::Slab;
use taylor_green::TaylorGreen;

/// The exact solution of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exact {
    TaylorGreen(TaylorGreen),
    Kovasznay(Kovasznay),
    Rotation(Rotation),
    /// A flow along x between two plates.
    Plates(Slab),
    /// Heat between two sides.
    Conduction(Slab),
}

impl Exact {
    /// The solution that the case names, for its box, fluid and viscosity; `None` where it names none.
    pub fn of(case: &Case) -> Option<Self> {
        let viscosity = case.effects.viscosity.as_ref().map_or(0.0, |viscosity| viscosity.kinematic);
        let density = case.fluid.density;
        let shorter = case.domain.width.min(case.domain.height);
        case.exact.as_ref().map(|exact| match exact.solution {
            Solution::TaylorGreen => Exact::TaylorGreen(TaylorGreen::new(shorter, viscosity, density)),
            Solution::Kovasznay => Exact::Kovasznay(Kovasznay::new(viscosity, density)),
            Solution::Couette | Solution::Poiseuille => Exact::Plates(Slab {
                length: case.domain.height,
                upright: true,
                diffusivity: viscosity,
                plates: [case.boundaries.bottom.velocity[0], case.boundaries.top.velocity[0]],
                initial: 0.0,
                source: case.effects.gravity.as_ref().map_or(0.0, |gravity| gravity.acceleration[0]),
            }),
            Solution::Conduction => {
                let heat = case.effects.heat.as_ref();
                let held = [&case.boundaries.left, &case.boundaries.right].map(|wall| wall.temperature.unwrap_or(0.0));
                Exact::Conduction(Slab {
                    length: case.domain.width,
                    upright: false,
                    diffusivity: heat.map_or(0.0, |heat| heat.diffusivity),
                    plates: held,
                    initial: heat.map_or(0.0, |heat| heat.initial),
                    source: 0.0,
                })
            }
            Solution::Rotation => Exact::Rotation(Rotation::new(DVec2::new(case.domain.width, case.domain.height))),
        })
    }

    /// m/s at a place, m, and a time, s.
    pub fn velocity(&self, place: DVec2, time: f64) -> DVec2 {
        match self {
            Exact::TaylorGreen(flow) => flow.velocity(place, time),
            Exact::Kovasznay(flow) => flow.velocity(place),
            Exact::Rotation(flow) => flow.velocity(place),
            Exact::Plates(slab) => DVec2::new(slab.value(place, time), 0.0),
            Exact::Conduction(_) => DVec2::ZERO,
        }
    }

    /// Pa, but for a constant, at a place, m, and a time, s.
    pub fn pressure(&self, place: DVec2, time: f64) -> f64 {
        match self {
            Exact::TaylorGreen(flow) => flow.pressure(place, time),
            Exact::Kovasznay(flow) => flow.pressure(place),
            // There is none, or it is constant.
            Exact::Rotation(_) | Exact::Plates(_) | Exact::Conduction(_) => 0.0,
        }
    }

    /// What has become of a tracer at a place, m, and a time, s; `None` where that is not known.
    pub fn tracer(&self, tracer: &Tracer, place: DVec2, time: f64) -> Option<f64> {
        match self {
            Exact::Rotation(flow) => flow.tracer(tracer, place, time),
            _ => None,
        }
    }

    /// The temperature at a place, m, and a time, s, K; `None` where it is not known.
    pub fn temperature(&self, place: DVec2, time: f64) -> Option<f64> {
        match self {
            Exact::Conduction(slab) => Some(slab.value(place, time)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VISCOSITY: f64 = 0.025;
    const DENSITY: f64 = 3.0;

    fn flows() -> [Exact; 2] {
        [
            Exact::TaylorGreen(TaylorGreen::new(1.5, VISCOSITY, DENSITY)),
            Exact::Kovasznay(Kovasznay::new(VISCOSITY, DENSITY)),
        ]
    }

    /// What central differences leave of `Du/Dt + grad p / rho - nu lap u` and of `div u`, over the largest term.
    fn residuals(flow: &Exact, viscosity: f64) -> [f64; 2] {
        let h = 1e-4;
        let [x, y] = [DVec2::X * h, DVec2::Y * h];
        let mut worst = [0.0_f64; 2];
        for k in 0..40 {
            let (at, time) = (DVec2::new(0.037 * f64::from(k), 0.71 - 0.029 * f64::from(k)), 0.02 * f64::from(k));
            let u = |d: DVec2| flow.velocity(at + d, time);
            let slope = |d: DVec2| (u(d) - u(-d)) / (2.0 * h);
            let change = (flow.velocity(at, time + h) - flow.velocity(at, time - h)) / (2.0 * h);
            let carried = u(DVec2::ZERO).x * slope(x) + u(DVec2::ZERO).y * slope(y);
            let curvature = (u(x) + u(-x) + u(y) + u(-y) - 4.0 * u(DVec2::ZERO)) / (h * h);
            let p = |d: DVec2| flow.pressure(at + d, time) / DENSITY;
            let pressure = DVec2::new(p(x) - p(-x), p(y) - p(-y)) / (2.0 * h);
            let terms = [change, carried, pressure, -viscosity * curvature];
            let size = terms.iter().map(|term| term.length()).fold(0.1, f64::max);
            worst[0] = worst[0].max(terms.into_iter().sum::<DVec2>().length() / size);
            worst[1] = worst[1].max((slope(x).x + slope(y).y).abs());
        }
        worst
    }

    #[test]
    fn every_solution_solves_the_equations() {
        for flow in flows() {
            let [momentum, divergence] = residuals(&flow, VISCOSITY);
            assert!(momentum < 1e-5 && divergence < 1e-6, "{flow:?}: {momentum:e} {divergence:e}");
        }
    }

    #[test]
    fn a_wrong_viscosity_would_be_seen() {
        for flow in flows() {
            let [momentum, _] = residuals(&flow, 1.01 * VISCOSITY);
            assert!(momentum > 1e-4, "{flow:?}: {momentum:e}");
        }
    }
}
