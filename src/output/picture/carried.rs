//! temperature.png and tracer_NAME.png: a carried field over the domain.

use glam::DVec2;

use super::canvas::Canvas;
use super::map;
use super::scale::ColourScale;
use super::surface::Surface;
use super::text::Text;
use crate::case::Case;
use crate::measure::MeasureError;
use crate::snapshot::Snapshot;

pub fn draw(
    text: &Text,
    case: &Case,
    snapshot: &Snapshot,
    (name, values): (&str, &[f64]),
    title: &str,
) -> Result<Canvas, MeasureError> {
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let (columns, rows) = map::size(&case.domain);
    let (spacing, pixel) = (case.cloud.spacing, domain.x / columns as f64);
    let surface = Surface::new(&snapshot.position, spacing, case.domain.period(), pixel, [values])?;
    let raster = surface.raster(domain, columns, rows);
    let scale = ColourScale::signed(values);
    let colour = |column: usize, row: usize| scale.colour(raster.value[row * columns + column][0]);
    let bar = if name == "temperature" { ("T", "K") } else { (name, "1") };
    Ok(map::draw(text, &case.domain, title, &scale, bar, colour, |_, _| {}))
}
