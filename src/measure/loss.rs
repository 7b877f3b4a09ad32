//! How much of a tracer is there.

use super::MeasureError;
use crate::case::{Case, Tracer};
use crate::cloud::Cloud;
use crate::cloud::voronoi::Cells;

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
