//! speed.png: the speed over the domain, with arrows along the velocity.

use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use super::map;
use super::scale::{ColourScale, percentile};
use super::surface::{Raster, Surface};
use super::text::Text;
use crate::case::Case;
use crate::measure::MeasureError;
use crate::snapshot::Snapshot;

/// Distance of two arrows, and the longest and shortest of them, pixels.
const APART: f64 = 38.0;
const LONGEST: f64 = 36.0;
const SHORTEST: f64 = 4.0;

pub fn draw(text: &Text, case: &Case, snapshot: &Snapshot, title: &str) -> Result<Canvas, MeasureError> {
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let (columns, rows) = map::size(&case.domain);
    let [u, v]: [Vec<f64>; 2] =
        [snapshot.velocity.iter().map(|u| u.x).collect(), snapshot.velocity.iter().map(|u| u.y).collect()];
    let surface = Surface::of(case, &snapshot.position, domain.x / columns as f64, [&u, &v])?;
    let mut raster = surface.raster(domain, columns, rows);
    // No arrow stands in an obstacle.
    let covered = map::covered(case);
    for (k, value) in raster.value.iter_mut().enumerate() {
        if covered(k % columns, k / columns) {
            *value = [0.0; 2];
        }
    }
    let speed: Vec<f64> = snapshot.velocity.iter().map(|u| u.length()).collect();
    let scale = ColourScale::magnitude(&speed);
    let colour = |column: usize, row: usize| match covered(column, row) {
        true => map::BODY,
        false => scale.colour(velocity(&raster, column, row).length()),
    };
    let over = |canvas: &mut Canvas, corner: DVec2| draw_arrows(canvas, corner, &raster);
    Ok(map::draw(text, &case.domain, title, &scale, ("|u|", "m/s"), colour, over))
}

/// The velocity at a pixel, m/s.
fn velocity(raster: &Raster<2>, column: usize, row: usize) -> DVec2 {
    DVec2::from(raster.value[row * raster.width + column])
}

/// Arrows on a square lattice. Lengths go with the speed, and the fastest tenth, which would run into their neighbours,
/// have one length: the colour below tells them apart.
fn draw_arrows(canvas: &mut Canvas, corner: DVec2, raster: &Raster<2>) {
    let places = |pixels: usize| {
        let count = (pixels as f64 / APART).floor().max(1.0);
        (0..count as usize).map(move |k| (pixels as f64 * (k as f64 + 0.5) / count) as usize)
    };
    let sites: Vec<(DVec2, DVec2)> = places(raster.height)
        .flat_map(|row| places(raster.width).map(move |column| (column, row)))
        .map(|(column, row)| (DVec2::new(column as f64, row as f64) + 0.5, velocity(raster, column, row)))
        .collect();
    let mut speeds: Vec<f64> = sites.iter().map(|(_, velocity)| velocity.length()).collect();
    speeds.sort_unstable_by(f64::total_cmp);
    let reference = percentile(&speeds, 0.9);
    if reference <= 0.0 {
        return;
    }
    for (at, velocity) in sites {
        let speed = velocity.length();
        let length = LONGEST * (speed / reference).min(1.0);
        if length >= SHORTEST {
            let along = DVec2::new(velocity.x, -velocity.y) / speed;
            draw_arrow(canvas, corner + at, along, length);
        }
    }
}

/// A white arrow with a dark rim, so that it shows on every colour.
fn draw_arrow(canvas: &mut Canvas, middle: DVec2, along: DVec2, length: f64) {
    let head = (0.5 * length).min(11.0);
    let (tail, tip) = (middle - 0.5 * length * along, middle + 0.5 * length * along);
    let (neck, side) = (tip - head * along, 0.38 * head * along.perp());
    let corners = [tip, neck + side, neck - side];
    let rim = Rgb([20, 20, 40]);
    canvas.line(tail, neck, 4.0, rim, 0.55);
    canvas.polygon(&corners, 1.2, rim, 0.55);
    canvas.line(tail, neck, 1.8, Rgb::WHITE, 1.0);
    canvas.polygon(&corners, 0.0, Rgb::WHITE, 1.0);
}
