//! pressure.png: the pressure over the domain.

use glam::DVec2;

use super::canvas::Canvas;
use super::map;
use super::scale::ColourScale;
use super::surface::Surface;
use super::text::Text;
use crate::case::Case;
use crate::measure::MeasureError;
use crate::snapshot::Snapshot;

pub fn draw(text: &Text, case: &Case, snapshot: &Snapshot, title: &str) -> Result<Canvas, MeasureError> {
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let (columns, rows) = map::size(&case.domain);
    let surface = Surface::of(case, &snapshot.position, domain.x / columns as f64, [&snapshot.pressure])?;
    let raster = surface.raster(domain, columns, rows);
    let scale = ColourScale::signed(&snapshot.pressure);
    let covered = map::covered(case);
    let colour = |column: usize, row: usize| match covered(column, row) {
        true => map::BODY,
        false => scale.colour(raster.value[row * columns + column][0]),
    };
    Ok(map::draw(text, &case.domain, title, &scale, ("p", "Pa"), colour, |_, _| {}))
}
