//! The colour bar beside a map.

use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use super::frame::{Axis, LABEL, NUMBER, STROKE, TICK, outline};
use super::scale::ColourScale;
use super::text::{Anchor, Direction, Text};

/// Width of the bar and height of its arrow ends, pixels.
const WIDTH: f64 = 30.0;
const ARROW: f64 = 26.0;

/// Distance between two ticks that leaves their numbers apart, pixels.
const TICK_DISTANCE: f64 = 70.0;

/// A bar of `height` pixels.
#[derive(Debug)]
pub struct Bar<'a> {
    scale: &'a ColourScale,
    axis: Axis,
    height: f64,
}

impl<'a> Bar<'a> {
    pub fn new(scale: &'a ColourScale, height: f64, name: &str, unit: &str) -> Self {
        let count = (height / TICK_DISTANCE).round().clamp(2.0, 10.0) as usize;
        Self { scale, axis: Axis::new(scale.low, scale.high, count, name, unit), height }
    }

    /// Width with numbers and label, pixels.
    pub fn width(&self, text: &Text) -> f64 {
        WIDTH + TICK + 8.0 + self.axis.number_width(text) + 14.0 + LABEL + 8.0
    }

    /// Draws the bar with its upper left corner at `corner`; an arrow end says that values go on beyond the scale.
    pub fn draw(&self, canvas: &mut Canvas, text: &Text, corner: DVec2) {
        let arrow = |cut: bool| if cut { ARROW } else { 0.0 };
        let right = corner.x + WIDTH;
        let (top, bottom) = (corner.y + arrow(self.scale.cut_high), corner.y + self.height - arrow(self.scale.cut_low));
        let value = |y: f64| self.axis.low + (self.axis.high - self.axis.low) * (bottom - y) / (bottom - top);
        for y in top.round() as i64..bottom.round() as i64 {
            let colour = self.scale.colour(value(y as f64 + 0.5));
            for x in corner.x as i64..right as i64 {
                canvas.blend(x, y, colour, 1.0);
            }
        }
        let middle = corner.x + 0.5 * WIDTH;
        for (cut, edge, tip, end) in [
            (self.scale.cut_high, top, corner.y, self.axis.high),
            (self.scale.cut_low, bottom, corner.y + self.height, self.axis.low),
        ] {
            if cut {
                let corners = [DVec2::new(corner.x, edge), DVec2::new(middle, tip), DVec2::new(right, edge)];
                canvas.polygon(&corners, 0.0, self.scale.colour(end), 1.0);
                canvas.polyline(&corners, STROKE, Rgb::BLACK);
            }
        }
        outline(canvas, DVec2::new(corner.x, top), DVec2::new(right, bottom));
        for (&tick, label) in self.axis.ticks.values.iter().zip(&self.axis.ticks.labels) {
            let foot = DVec2::new(right, bottom - self.axis.share(tick) * (bottom - top));
            canvas.line(foot, foot + TICK * DVec2::X, STROKE, Rgb::BLACK, 1.0);
            let at = foot + (TICK + 8.0) * DVec2::X;
            text.draw(canvas, label, at, NUMBER, Anchor::Start, Direction::Rightwards);
        }
        let at =
            DVec2::new(right + TICK + 8.0 + self.axis.number_width(text) + 14.0 + 0.5 * LABEL, 0.5 * (top + bottom));
        text.draw(canvas, &self.axis.label, at, LABEL, Anchor::Middle, Direction::Upwards);
    }
}
