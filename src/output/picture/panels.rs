//! gradient.png and laplacian.png: one derivative of a known field by both families of operators, side by side on a lattice and
//! on scattered points, the error under each; the paper's Fig. 1.

use glam::DVec2;

use super::bar::Bar;
use super::canvas::Canvas;
use super::frame::{Axis, BELOW, Frame, LABEL, draw_title, title_height};
use super::scale::ColourScale;
use super::text::{Anchor, Direction, Text};
use crate::case::{Arrangement, Case, Operators};
use crate::comparison::Panel;

/// Longer side of a panel's map, pixels.
const SIDE: f64 = 440.0;
const EDGE: f64 = 20.0;
const GAP: f64 = 36.0;
/// Height of the line above a panel and of the one below it.
const LINE: f64 = 1.8 * LABEL;
/// Radius of a point's disc, in spacings: neighbours on a lattice touch.
const DISC: f64 = 0.5;

/// Which derivative a figure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// Along x.
    Gradient,
    Laplacian,
}

impl Shown {
    fn values(self, panel: &Panel) -> Vec<f64> {
        match self {
            Shown::Gradient => panel.derivatives.gradient.iter().map(|gradient| gradient.x).collect(),
            Shown::Laplacian => panel.derivatives.laplacian.clone(),
        }
    }

    fn error(self, panel: &Panel) -> f64 {
        match self {
            Shown::Gradient => panel.gradient_error,
            Shown::Laplacian => panel.laplacian_error.unwrap_or(f64::NAN),
        }
    }

    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Shown::Gradient => ("first derivative along x", "dφ/dx", "1/m"),
            Shown::Laplacian => ("Laplacian", "∆φ", "1/m²"),
        }
    }
}

/// Draws the four panels, two by two. `exact` are the exact values, from which the colours take their range.
pub fn draw(text: &Text, case: &Case, panels: &[Panel], shown: Shown, exact: &[f64]) -> Canvas {
    let (name, symbol, unit) = shown.words();
    let scale = ColourScale::signed(exact);
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let size = (SIDE / domain.max_element() * domain).round();
    let x = Axis::new(0.0, domain.x, (size.x / 110.0).round().max(1.0) as usize, "x", "m");
    let y = Axis::new(0.0, domain.y, (size.y / 90.0).round().max(1.0) as usize, "y", "m");
    let left = (EDGE + y.left_room(text)).ceil();
    let (across, down) = (size.x + left - EDGE + GAP, LINE + size.y + BELOW + LINE + GAP);
    let bar = Bar::new(&scale, down + size.y, symbol, unit);
    let total = left + across + size.x + GAP + bar.width(text) + EDGE;
    let title = format!("{}: {name}", case.title);
    let top = title_height(text, &title, total);
    let mut canvas = Canvas::new(total.ceil() as u32, (top + 2.0 * down - GAP + EDGE).ceil() as u32);
    draw_title(&mut canvas, text, &title, total);
    for (k, panel) in panels.iter().enumerate() {
        let low = DVec2::new(left + across * (k % 2) as f64, top + LINE + down * (k / 2) as f64).round();
        let frame = Frame { low, high: low + size, x: x.clone(), y: y.clone() };
        let middle = low.x + 0.5 * size.x;
        let line = |canvas: &mut Canvas, words: &str, y: f64, size: f64| {
            text.draw(canvas, words, DVec2::new(middle, y), size, Anchor::Middle, Direction::Rightwards);
        };
        let radius = DISC * case.cloud.spacing * size.x / domain.x;
        for (place, &value) in panel.position.iter().zip(&shown.values(panel)) {
            canvas.disc(frame.place(place.x, place.y), radius.max(0.8), scale.colour(value));
        }
        frame.draw(&mut canvas, text);
        line(&mut canvas, &heading(panel), low.y - 0.6 * LINE - radius, LABEL);
        let error = format!("error {}", percent(shown.error(panel)));
        line(&mut canvas, &error, low.y + size.y + BELOW + 0.4 * LINE, LABEL);
    }
    let corner = DVec2::new(left + across + size.x + GAP, top + LINE);
    bar.draw(&mut canvas, text, corner.round());
    canvas
}

fn heading(panel: &Panel) -> String {
    let form = match panel.operators {
        Operators::Integral => "integral form",
        Operators::Interpolation => "interpolation form",
    };
    let points = match panel.arrangement {
        Arrangement::Regular => "regular",
        Arrangement::Jittered => "jittered",
        Arrangement::Random => "random",
        Arrangement::Relaxed => "relaxed",
    };
    format!("{form}, {points} points")
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let decimals = (1.0 - percent.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{percent:.decimals$}%")
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn percents_have_two_digits() {
        assert_eq!([0.5, 0.0123, 0.00051, 12.0].map(percent), ["50%", "1.2%", "0.051%", "1200%"]);
    }
}
