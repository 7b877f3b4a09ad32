//! The axes of a figure: a frame, ticks with numbers, and a label on each side.

use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use super::text::{Anchor, Direction, Text};
use super::ticks::Ticks;

/// Sizes of text, pixels per em.
pub const TITLE: f64 = 25.0;
pub const LABEL: f64 = 23.0;
pub const NUMBER: f64 = 20.0;
pub const LEGEND: f64 = 18.0;

/// Length of a tick and width of the frame's lines, pixels.
pub const TICK: f64 = 8.0;
pub const STROKE: f64 = 1.8;

/// One axis: the range it shows, what it shows and in which unit.
#[derive(Debug, Clone)]
pub struct Axis {
    pub low: f64,
    pub high: f64,
    pub ticks: Ticks,
    pub label: String,
}

impl Axis {
    /// `count` is about how many ticks it has.
    pub fn new(low: f64, high: f64, count: usize, name: &str, unit: &str) -> Self {
        let ticks = Ticks::new(low, high, count);
        let label = format!("{name} {}", ticks.unit(unit));
        Self { low, high, ticks, label }
    }

    /// An axis of powers of ten: `low` and `high` above 0. It takes and holds decimal logarithms; `unit` follows each number.
    pub fn logarithmic(low: f64, high: f64, label: &str, unit: &str) -> Self {
        let ticks = Ticks::decades(low, high, unit);
        Self { low: low.log10(), high: high.log10(), ticks, label: label.to_owned() }
    }

    pub fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Width of the widest number, pixels.
    pub fn number_width(&self, text: &Text) -> f64 {
        self.ticks.labels.iter().map(|label| text.width(label, NUMBER)).fold(0.0, f64::max)
    }

    /// Room that ticks, numbers and label need left of the frame, pixels.
    pub fn left_room(&self, text: &Text) -> f64 {
        TICK + 8.0 + self.number_width(text) + 14.0 + LABEL + 8.0
    }
}

/// Room that ticks, numbers and label need below the frame, pixels.
pub const BELOW: f64 = TICK + 10.0 + NUMBER + 10.0 + LABEL + 6.0;

/// The rectangle of a plot, in pixels, with its axes.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Upper left corner.
    pub low: DVec2,
    /// Lower right corner.
    pub high: DVec2,
    pub x: Axis,
    pub y: Axis,
}

impl Frame {
    /// Where a pair of values stands, pixels.
    pub fn place(&self, x: f64, y: f64) -> DVec2 {
        let share = DVec2::new(self.x.share(x), 1.0 - self.y.share(y));
        self.low + share * (self.high - self.low)
    }

    /// Pale lines at the ticks, to be drawn below everything else.
    pub fn draw_grid(&self, canvas: &mut Canvas) {
        for &x in &self.x.ticks.values {
            canvas.line(self.place(x, self.y.low), self.place(x, self.y.high), 1.0, Rgb::GRID, 1.0);
        }
        for &y in &self.y.ticks.values {
            canvas.line(self.place(self.x.low, y), self.place(self.x.high, y), 1.0, Rgb::GRID, 1.0);
        }
    }

    pub fn draw(&self, canvas: &mut Canvas, text: &Text) {
        outline(canvas, self.low, self.high);
        let middle = 0.5 * (self.low + self.high);
        for (&value, label) in self.x.ticks.values.iter().zip(&self.x.ticks.labels) {
            let foot = self.place(value, self.y.low);
            canvas.line(foot, foot + TICK * DVec2::Y, STROKE, Rgb::BLACK, 1.0);
            let at = foot + (TICK + 8.0 + 0.5 * NUMBER) * DVec2::Y;
            text.draw(canvas, label, at, NUMBER, Anchor::Middle, Direction::Rightwards);
        }
        let at = DVec2::new(middle.x, self.high.y + TICK + 10.0 + NUMBER + 10.0 + 0.5 * LABEL);
        text.draw(canvas, &self.x.label, at, LABEL, Anchor::Middle, Direction::Rightwards);

        for (&value, label) in self.y.ticks.values.iter().zip(&self.y.ticks.labels) {
            let foot = self.place(self.x.low, value);
            canvas.line(foot - TICK * DVec2::X, foot, STROKE, Rgb::BLACK, 1.0);
            text.draw(canvas, label, foot - (TICK + 8.0) * DVec2::X, NUMBER, Anchor::End, Direction::Rightwards);
        }
        let left = self.low.x - TICK - 8.0 - self.y.number_width(text) - 14.0 - 0.5 * LABEL;
        text.draw(canvas, &self.y.label, DVec2::new(left, middle.y), LABEL, Anchor::Middle, Direction::Upwards);
    }
}

/// A rectangle's four sides.
pub fn outline(canvas: &mut Canvas, low: DVec2, high: DVec2) {
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y), low];
    canvas.polyline(&corners, STROKE, Rgb::BLACK);
}

/// The figure's title, broken into lines and centred; returns the height it takes from the top, pixels.
pub fn title_height(text: &Text, title: &str, width: f64) -> f64 {
    18.0 + text.wrap(title, TITLE, width - 40.0).len() as f64 * 1.35 * TITLE + 10.0
}

/// Draws the title at the top of a figure `width` pixels wide.
pub fn draw_title(canvas: &mut Canvas, text: &Text, title: &str, width: f64) {
    for (k, line) in text.wrap(title, TITLE, width - 40.0).iter().enumerate() {
        let at = DVec2::new(0.5 * width, 18.0 + (k as f64 + 0.5) * 1.35 * TITLE);
        text.draw(canvas, line, at, TITLE, Anchor::Middle, Direction::Rightwards);
    }
}
