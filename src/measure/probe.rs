//! Single numbers of a flow that a run reports as it goes: forces on obstacles, differences between places, fluxes.
//!
//! The force on a body, `F = int sigma . n dS`, `sigma = -p I + mu (grad u + grad u^T)`, `n` out of the body. Discrete: a sum over
//! the points of its outline, `F = sum_i sigma_i . A_i n_i`, `A_i n_i` the piece of outline between the places half way to
//! the next points on either side. The pressure is that of the points, gradients are those of cubic fits around them. Flux, out
//! of the fluid, `int u . n dS`: along a side by Simpson's rule on fits, on an outline the same sum as above.
//! Units, in two dimensions per metre of the third: N/m, m^2/s.

use glam::DVec2;

use super::{MeasureError, Sampler};
use crate::case::{Case, Component, Expectation, Measure};
use crate::cloud::{Traced, outlines};
use crate::snapshot::Snapshot;

/// Intervals of the rule along a side, a spacing.
const INTERVALS_PER_SPACING: f64 = 4.0;

/// One number, by the name that its column and its expectation have.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    pub name: String,
    of: Quantity,
    /// Factors of each component at each point.
    terms: Vec<Term>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Velocity,
    Pressure,
    /// Of both.
    Force,
}

/// What one point adds: `velocity . u + pressure p`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    point: usize,
    velocity: DVec2,
    pressure: f64,
}

impl Probe {
    /// Those that have a column in the diagnostics: both forces on every obstacle, and every difference and flux that the case
    /// expects.
    ///
    /// # Errors
    /// Points that can't be measured.
    pub fn of_case(case: &Case, position: &[DVec2]) -> Result<Vec<Self>, MeasureError> {
        let asked = case.expect.iter().filter(|(_, row)| matches!(row.measure, Measure::Difference | Measure::Flux));
        let asked: Vec<(&String, &Expectation)> = asked.collect();
        if case.obstacles.is_empty() && asked.is_empty() {
            return Ok(Vec::new());
        }
        let sampler = Sampler::of(case, position)?;
        let traced = outlines(case)?;
        let mut probes = Vec::new();
        for (obstacle, traced) in case.obstacles.iter().zip(&traced) {
            for (axis, name) in [(DVec2::X, "force_x"), (DVec2::Y, "force_y")] {
                let name = format!("{name}_{}", obstacle.name);
                probes.push(Self::force(name, case, &sampler, traced, axis));
            }
        }
        for (name, row) in asked {
            probes.push(Self::with_traced(name, row, case, &sampler, &traced)?);
        }
        Ok(probes)
    }

    /// What an expectation measures.
    ///
    /// # Errors
    /// Keys that are missing or name nothing.
    pub fn of_expectation(name: &str, row: &Expectation, case: &Case, sampler: &Sampler) -> Result<Self, MeasureError> {
        Self::with_traced(name, row, case, sampler, &outlines(case)?)
    }

    fn with_traced(
        name: &str,
        row: &Expectation,
        case: &Case,
        sampler: &Sampler,
        traced: &[Traced],
    ) -> Result<Self, MeasureError> {
        let fail = |what: &str| MeasureError::Expectation { name: name.to_owned(), what: what.to_owned() };
        let named = name.to_owned();
        if row.measure == Measure::Difference {
            let places = row.between.ok_or_else(|| fail("`between` is missing"))?;
            let component = row.component.ok_or_else(|| fail("`component` is missing"))?;
            return Ok(Self::difference(named, component, sampler, places.map(DVec2::from_array)));
        }
        let on = row.on.as_deref().ok_or_else(|| fail("`on` is missing"))?;
        let body = case.obstacles.iter().position(|obstacle| obstacle.name == on).map(|number| &traced[number]);
        match (row.measure, body) {
            (Measure::Force, Some(traced)) => {
                let axis = if row.component == Some(Component::X) { DVec2::X } else { DVec2::Y };
                Ok(Self::force(named, case, sampler, traced, axis))
            }
            (Measure::Force, None) => Err(fail("`on` names no obstacle")),
            (_, Some(traced)) => Ok(Self::flux_of(named, sampler, traced)),
            (_, None) => Ok(Self::flux_through(named, case, sampler, on)),
        }
    }

    fn force(name: String, case: &Case, sampler: &Sampler, traced: &Traced, axis: DVec2) -> Self {
        let viscosity = case.effects.viscosity.as_ref().map_or(0.0, |viscosity| viscosity.kinematic);
        let dynamic = case.fluid.density * viscosity;
        let mut terms = Vec::new();
        for (place, piece) in pieces(traced) {
            let point = sampler.nearest(place);
            terms.push(Term { point, velocity: DVec2::ZERO, pressure: -piece.dot(axis) });
            let Some((points, [x, y])) = sampler.slope(place) else { continue };
            for (k, point) in points.into_iter().enumerate() {
                // axis . (grad u + grad u^T) . piece, a sum over the components of u.
                let slope = DVec2::new(x[k], y[k]);
                let velocity = dynamic * (axis * slope.dot(piece) + piece * slope.dot(axis));
                terms.push(Term { point, velocity, pressure: 0.0 });
            }
        }
        Self { name, of: Quantity::Force, terms }
    }

    fn difference(name: String, component: Component, sampler: &Sampler, [first, second]: [DVec2; 2]) -> Self {
        let of = if component == Component::P { Quantity::Pressure } else { Quantity::Velocity };
        let velocity = match component {
            Component::U => DVec2::X,
            Component::V => DVec2::Y,
            _ => DVec2::ZERO,
        };
        let pressure = if component == Component::P { 1.0 } else { 0.0 };
        let mut terms = Vec::new();
        for (place, sign) in [(first, 1.0), (second, -1.0)] {
            let stencil = sampler.stencil(place);
            terms.extend(stencil.points.iter().zip(&stencil.weights).map(|(&point, weight)| Term {
                point,
                velocity: sign * weight * velocity,
                pressure: sign * weight * pressure,
            }));
        }
        Self { name, of, terms }
    }

    fn flux_of(name: String, sampler: &Sampler, traced: &Traced) -> Self {
        // Out of the fluid is into the body.
        let term =
            |(place, piece): (DVec2, DVec2)| Term { point: sampler.nearest(place), velocity: -piece, pressure: 0.0 };
        Self { name, of: Quantity::Velocity, terms: pieces(traced).map(term).collect() }
    }

    fn flux_through(name: String, case: &Case, sampler: &Sampler, side: &str) -> Self {
        let size = DVec2::new(case.domain.width, case.domain.height);
        let (from, to, normal) = match side {
            "left" => (DVec2::ZERO, DVec2::new(0.0, size.y), DVec2::NEG_X),
            "right" => (DVec2::new(size.x, 0.0), size, DVec2::X),
            "bottom" => (DVec2::ZERO, DVec2::new(size.x, 0.0), DVec2::NEG_Y),
            _ => (DVec2::new(0.0, size.y), size, DVec2::Y),
        };
        let length = from.distance(to);
        let half = (0.5 * INTERVALS_PER_SPACING * length / sampler.spacing()).ceil().max(1.0) as usize;
        let mut terms = Vec::new();
        for k in 0..=2 * half {
            let share = match k {
                0 => 1.0,
                k if k == 2 * half => 1.0,
                k => [2.0, 4.0][k % 2],
            };
            let factor = share * length / (6.0 * half as f64);
            let stencil = sampler.stencil(from.lerp(to, k as f64 / (2 * half) as f64));
            terms.extend(stencil.points.iter().zip(&stencil.weights).map(|(&point, weight)| Term {
                point,
                velocity: factor * weight * normal,
                pressure: 0.0,
            }));
        }
        Self { name, of: Quantity::Velocity, terms }
    }

    /// The number at the time of a snapshot of the same points: N/m, m^2/s, Pa or m/s.
    pub fn value(&self, snapshot: &Snapshot) -> f64 {
        let velocity = |term: &Term| term.velocity.dot(snapshot.velocity[term.point]);
        let pressure = |term: &Term| term.pressure * snapshot.pressure[term.point];
        match self.of {
            Quantity::Velocity => self.terms.iter().map(velocity).sum(),
            Quantity::Pressure => self.terms.iter().map(pressure).sum(),
            Quantity::Force => self.terms.iter().map(|term| velocity(term) + pressure(term)).sum(),
        }
    }
}

/// The points of an outline, and the piece of it around each, out of the body and as long as the piece, m.
fn pieces(traced: &Traced) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    let count = traced.place.len();
    (0..count).map(move |k| {
        let along = traced.middle[k] - traced.middle[(k + count - 1) % count];
        (traced.place[k], -along.perp())
    })
}
