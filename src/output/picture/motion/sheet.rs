//! States of points that move side by side: as maps of the pressure, or with the pressure as a height over the plane.

use glam::DVec2;

use super::super::bar::Bar;
use super::super::canvas::Canvas;
use super::super::colour::Rgb;
use super::super::frame::{LABEL, NUMBER, draw_title, outline, title_height};
use super::super::scale::ColourScale;
use super::super::text::{Anchor, Direction, Text};
use crate::snapshot::Snapshot;

const EDGE: f64 = 24.0;
const GAP: f64 = 26.0;
/// Height of a line of words above a cell.
const LINE: f64 = 1.6 * NUMBER;
/// The colour bar is as high as the cells, within these, pixels.
const LOWEST_BAR: f64 = 200.0;
const HIGHEST_BAR: f64 = 560.0;
/// Radius of a point's disc, in spacings.
pub const DISC: f64 = 0.55;
/// Oblique view: how far a metre into the picture goes right and up, in metres, and the height of the largest pressure, in
/// widths of a cell.
const RIGHT: f64 = 0.42;
const UP: f64 = 0.36;
const HIGHEST: f64 = 0.36;

/// How a state is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    Map,
    /// As in the paper's Fig. 3.
    Heights,
}

/// One place of the sheet: words above it, and a state; none leaves the place empty.
#[derive(Debug, Clone)]
pub struct Cell {
    pub words: String,
    pub state: Option<Snapshot>,
    /// Distance of neighbouring points, m.
    pub spacing: f64,
}

/// A sheet of cells, row by row.
#[derive(Debug)]
pub struct Sheet<'a> {
    pub title: &'a str,
    /// Width and height, m.
    pub domain: DVec2,
    pub view: View,
    pub scale: &'a ColourScale,
    /// Over each column; may be empty.
    pub headings: &'a [String],
    pub columns: usize,
    /// Width of a cell, pixels.
    pub width: f64,
}

impl Sheet<'_> {
    pub fn draw(&self, text: &Text, cells: &[Cell]) -> Canvas {
        let size = self.cell_size();
        let rows = cells.len().div_ceil(self.columns) as f64;
        let head = if self.headings.is_empty() { 0.0 } else { 1.9 * LABEL };
        let body = rows * (LINE + size.y) + (rows - 1.0) * GAP;
        let bar_height = (body - LINE).clamp(LOWEST_BAR, HIGHEST_BAR);
        let bar = Bar::new(self.scale, bar_height, "p", "Pa");
        let columns = self.columns as f64;
        let grid = columns * size.x + (columns - 1.0) * GAP;
        let total = EDGE + grid + 1.5 * GAP + bar.width(text) + EDGE;
        let top = (title_height(text, self.title, total) + head).ceil();
        let height = top + body.max(LINE + bar_height) + EDGE;
        let mut canvas = Canvas::new(total.ceil() as u32, height.ceil() as u32);
        draw_title(&mut canvas, text, self.title, total);
        let corner = |k: usize| {
            let (column, row) = ((k % self.columns) as f64, (k / self.columns) as f64);
            DVec2::new(EDGE + column * (size.x + GAP), top + row * (LINE + size.y + GAP) + LINE).round()
        };
        for (k, heading) in self.headings.iter().enumerate() {
            let at = corner(k) + DVec2::new(0.5 * size.x, -LINE - 0.5 * head);
            let heading = text.cut(heading, LABEL, size.x);
            text.draw(&mut canvas, &heading, at, LABEL, Anchor::Middle, Direction::Rightwards);
        }
        for (k, cell) in cells.iter().enumerate() {
            let low = corner(k);
            let at = low - 0.5 * LINE * DVec2::Y;
            text.draw(&mut canvas, &cell.words, at, NUMBER, Anchor::Start, Direction::Rightwards);
            match self.view {
                View::Map => self.map(&mut canvas, low, size, cell),
                View::Heights => self.heights(&mut canvas, low, size, cell),
            }
        }
        bar.draw(&mut canvas, text, DVec2::new(EDGE + grid + 1.5 * GAP, top + LINE).round());
        canvas
    }

    /// Pixels to a metre.
    fn pixels(&self) -> f64 {
        match self.view {
            View::Map => self.width / self.domain.x,
            View::Heights => self.width / (self.domain.x + RIGHT * self.domain.y),
        }
    }

    /// The largest pressure's height, and the lowest negative one's depth, pixels.
    fn rise(&self) -> (f64, f64) {
        let most = self.scale.high.max(-self.scale.low).max(f64::MIN_POSITIVE);
        let height = |value: f64| HIGHEST * self.width * (value / most).max(0.0);
        (height(self.scale.high), height(-self.scale.low))
    }

    fn cell_size(&self) -> DVec2 {
        let height = match self.view {
            View::Map => self.domain.y * self.pixels(),
            View::Heights => UP * self.domain.y * self.pixels() + self.rise().0 + self.rise().1 + 12.0,
        };
        DVec2::new(self.width, height).round()
    }

    fn map(&self, canvas: &mut Canvas, low: DVec2, size: DVec2, cell: &Cell) {
        if let Some(state) = &cell.state {
            let frame = (low, self.pixels(), self.domain);
            discs(canvas, state, &state.pressure, self.scale, frame, DISC * cell.spacing);
        }
        outline(canvas, low, low + size);
    }

    fn heights(&self, canvas: &mut Canvas, low: DVec2, size: DVec2, cell: &Cell) {
        let (pixels, (high, depth)) = (self.pixels(), self.rise());
        let floor = low + DVec2::new(0.0, size.y - depth - 6.0);
        let plane = |place: DVec2| floor + pixels * DVec2::new(place.x + RIGHT * place.y, -UP * place.y);
        let (x, y) = (self.domain.x * DVec2::X, self.domain.y * DVec2::Y);
        let corners = [DVec2::ZERO, x, x + y, y, DVec2::ZERO].map(plane);
        canvas.polygon(&corners[..4], 0.0, Rgb::GRID, 0.5);
        canvas.polyline(&corners, 1.4, Rgb::BLACK);
        let Some(state) = &cell.state else { return };
        let most = self.scale.high.max(-self.scale.low).max(f64::MIN_POSITIVE);
        let radius = (DISC * cell.spacing * pixels).max(0.9);
        let mut order: Vec<usize> = (0..state.position.len()).collect();
        order.sort_by(|&a, &b| state.position[b].y.total_cmp(&state.position[a].y));
        for point in order.into_iter().filter(|&point| inside(state.position[point], self.domain)) {
            let foot = plane(state.position[point]);
            let value = state.pressure[point].clamp(self.scale.low, self.scale.high);
            let tip = foot - (high.max(depth) * value / most) * DVec2::Y;
            let colour = self.scale.colour(value);
            canvas.line(foot, tip, 2.0 * radius, colour.paler(0.55), 1.0);
            canvas.disc(tip, radius, colour);
        }
    }
}

/// Draws every point of a map as a disc. The map has its upper left corner, its pixels to a metre and its sides, m, in the tuple.
pub fn discs(
    canvas: &mut Canvas,
    state: &Snapshot,
    values: &[f64],
    scale: &ColourScale,
    (low, pixels, domain): (DVec2, f64, DVec2),
    radius: f64,
) {
    let radius = (radius * pixels).max(0.8);
    for (place, &value) in state.position.iter().zip(values) {
        // Points that have left the domain are not drawn over what stands around it.
        if inside(*place, domain) {
            let at = low + pixels * DVec2::new(place.x, domain.y - place.y);
            canvas.disc(at, radius, scale.colour(value));
        }
    }
}

fn inside(place: DVec2, domain: DVec2) -> bool {
    (0.0..=domain.x).contains(&place.x) && (0.0..=domain.y).contains(&place.y)
}
