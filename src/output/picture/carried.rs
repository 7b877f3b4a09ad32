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
    let surface = Surface::of(case, &snapshot.position, domain.x / columns as f64, [values])?;
    let raster = surface.raster(domain, columns, rows);
    let scale = ColourScale::signed(values);
    let covered = map::covered(case);
    let colour = |column: usize, row: usize| match covered(column, row) {
        true => map::BODY,
        false => scale.colour(raster.value[row * columns + column][0]),
    };
    let bar = if name == "temperature" { ("T", "K") } else { (name, "1") };
    Ok(map::draw(text, &case.domain, title, &scale, bar, colour, |_, _| {}))
}
