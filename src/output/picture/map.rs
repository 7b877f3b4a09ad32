//! A figure with one map of the domain: title, axes and colour bar around it.

use glam::DVec2;

use super::bar::Bar;
use super::canvas::Canvas;
use super::colour::Rgb;
use super::frame::{Axis, BELOW, Frame, draw_title, title_height};
use super::scale::ColourScale;
use super::text::Text;
use crate::case::{Case, Domain};
use crate::cloud::Shape;

/// Width of a figure, pixels; a tall domain gives a narrower one.
const WIDTH: f64 = 1200.0;
const TALLEST_MAP: f64 = 1200.0;
/// A bar beside a flat map is at least this high.
const LOWEST_BAR: f64 = 170.0;
const GAP: f64 = 34.0;
const EDGE: f64 = 20.0;

/// Room left for numbers and labels beside the map when its size is chosen, pixels.
const BESIDE: f64 = 290.0;

/// Sides of the map, whole pixels.
pub fn size(domain: &Domain) -> (usize, usize) {
    let aspect = domain.width / domain.height;
    let width = (WIDTH - BESIDE).min(TALLEST_MAP * aspect);
    let whole = |x: f64| (x.round() as usize).max(24);
    (whole(width), whole(width / aspect))
}

/// What obstacles are painted with.
pub const BODY: Rgb = Rgb([120, 120, 125]);

/// True of the pixels whose middle lies in an obstacle.
pub fn covered(case: &Case) -> impl Fn(usize, usize) -> bool + Sync {
    let (columns, rows) = size(&case.domain);
    let pixel = DVec2::new(case.domain.width / columns as f64, case.domain.height / rows as f64);
    let shapes: Vec<Shape> = case.obstacles.iter().map(Shape::of).collect();
    move |column, row| {
        let place = pixel * (DVec2::new(column as f64, (rows - 1 - row) as f64) + 0.5);
        shapes.iter().any(|shape| shape.distance(place) < 0.0)
    }
}

/// Lays out a figure and draws it; `colour` gives the map's pixels from the top left one.
pub fn draw(
    text: &Text,
    domain: &Domain,
    title: &str,
    scale: &ColourScale,
    bar: (&str, &str),
    colour: impl Fn(usize, usize) -> Rgb,
    over: impl FnOnce(&mut Canvas, DVec2),
) -> Canvas {
    let (columns, rows) = size(domain);
    let (width, height) = (columns as f64, rows as f64);
    let count = |pixels: f64, apart: f64| (pixels / apart).round().clamp(1.0, 8.0) as usize;
    let x = Axis::new(0.0, domain.width, count(width, 130.0), "x", "m");
    let y = Axis::new(0.0, domain.height, count(height, 90.0), "y", "m");
    let bar_height = height.max(LOWEST_BAR);
    let bar = Bar::new(scale, bar_height, bar.0, bar.1);

    let left = (EDGE + y.left_room(text)).ceil();
    let total = left + width + GAP + bar.width(text) + EDGE;
    let top = (title_height(text, title, total) + 0.5 * (bar_height - height)).ceil();
    let bottom = (top + height + BELOW).max(top + 0.5 * (height + bar_height)) + EDGE;
    let mut canvas = Canvas::new(total.ceil() as u32, bottom.ceil() as u32);

    draw_title(&mut canvas, text, title, total);
    let low = DVec2::new(left, top);
    for row in 0..rows {
        for column in 0..columns {
            canvas.set(left as u32 + column as u32, top as u32 + row as u32, colour(column, row));
        }
    }
    over(&mut canvas, low);
    Frame { low, high: low + DVec2::new(width, height), x, y }.draw(&mut canvas, text);
    bar.draw(&mut canvas, text, DVec2::new(left + width + GAP, (top + 0.5 * (height - bar_height)).round()));
    canvas
}
