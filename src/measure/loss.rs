//! How much of a tracer is there, and how much fluid comes in and goes out.

use glam::DVec2;

use super::{MeasureError, Sampler};
use crate::case::{Case, SideKind, Tracer};
use crate::cloud::voronoi::Cells;
use crate::cloud::{Cloud, Side};

/// The cloud of a case and its cells once more; `field` has a value for each point.
///
/// # Errors
/// A cloud that cannot be laid out again, or one of another number of points.
pub fn laid_out(case: &Case, field: &[f64], name: &str) -> Result<(Cloud, Cells), MeasureError> {
    let fail = |what: String| MeasureError::Expectation { name: name.to_owned(), what };
    let cloud = Cloud::build(case).map_err(|error| fail(error.to_string()))?;
    if field.len() != cloud.len() {
        return Err(fail(format!("{} values for {} points", field.len(), cloud.len())));
    }
    let cells = Cells::build(&cloud);
    Ok((cloud, cells))
}

/// The integral over the domain at the beginning and of `found`, by the volumes of the Voronoi cells, m^2.
///
/// # Errors
/// As [`laid_out`].
pub fn amounts(case: &Case, tracer: &Tracer, found: &[f64]) -> Result<[f64; 2], MeasureError> {
    let (cloud, cells) = laid_out(case, found, &tracer.name)?;
    let places = cloud.position.iter().zip(&cells.volume);
    let initial = places.map(|(&place, volume)| volume * tracer.initially(place)).sum();
    Ok([initial, found.iter().zip(&cells.volume).map(|(value, volume)| volume * value).sum()])
}

/// What comes in through the inlets and what goes out through the outlets, m^2/s: places a spacing apart, the trapezoidal rule between
/// them.
pub fn flows(sampler: &Sampler, case: &Case, velocity: &[DVec2]) -> [f64; 2] {
    let size = DVec2::new(case.domain.width, case.domain.height);
    let [u, v]: [Vec<f64>; 2] = [velocity.iter().map(|u| u.x).collect(), velocity.iter().map(|u| u.y).collect()];
    let mut flows = [0.0; 2];
    for side in [Side::Left, Side::Right, Side::Bottom, Side::Top] {
        let (normal, kind) = (side.normal(), side.wall(&case.boundaries).kind);
        let along = normal.perp().abs();
        let corner = normal.max(DVec2::ZERO) * size;
        let length = size.dot(along);
        let count = (length / sampler.spacing()).round().max(1.0) as usize;
        let out = |k: usize| {
            let place = corner + along * (length * k as f64 / count as f64);
            let share = if k == 0 || k == count { 0.5 } else { 1.0 };
            share * DVec2::new(sampler.value(place, &u), sampler.value(place, &v)).dot(normal)
        };
        let flux = || (0..=count).map(out).sum::<f64>() * length / count as f64;
        match kind {
            SideKind::Inlet => flows[0] -= flux(),
            SideKind::Outlet => flows[1] += flux(),
            SideKind::Wall | SideKind::Slip => {}
        }
    }
    flows
}
