//! centreline.png: components along lines through the domain, with the published values they are held to.

use std::collections::BTreeMap;

use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use super::frame::{Axis, BELOW, Frame, LABEL, LEGEND, draw_title, title_height};
use super::text::{Anchor, Direction, Text};
use super::ticks::short;
use crate::case::{Case, Component, Expectation, Line, Measure};
use crate::measure::{LineMeasure, MeasureError, Profile, Sampler};
use crate::snapshot::Snapshot;

const WIDTH: f64 = 1200.0;
const COLUMNS: usize = 2;
const EDGE: f64 = 16.0;
/// Height of a panel's plot, and of a line of its legend, pixels.
const PLOT: f64 = 430.0;
const ROW: f64 = 1.45 * LEGEND;
/// Where a legend's text begins, right of its sign.
const SIGN: f64 = 46.0;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Sign {
    Line,
    Circle(Rgb),
    /// A triangle, tip down.
    Minimum,
    /// A triangle, tip up.
    Maximum,
}

const CIRCLES: [Rgb; 3] = [Rgb::VERMILION, Rgb::GREEN, Rgb::PURPLE];

/// One plot: a component along a line, and what was published about it.
#[derive(Debug)]
struct Panel {
    heading: String,
    axes: (Axis, Axis),
    curve: Vec<DVec2>,
    marks: Vec<(Sign, Vec<DVec2>)>,
    legend: Vec<(Sign, String)>,
}

/// `profiles` holds the published profiles by the name of their expectation.
pub fn draw(
    text: &Text,
    case: &Case,
    snapshot: &Snapshot,
    profiles: &BTreeMap<String, Profile>,
    title: &str,
) -> Result<Canvas, MeasureError> {
    let sampler = Sampler::of(case, &snapshot.position)?;
    let panel = WIDTH / COLUMNS as f64;
    let panels = wanted(case)
        .into_iter()
        .map(|(component, line)| {
            let measure = LineMeasure::new(&sampler, snapshot, &case.domain, component, line)?;
            Ok(prepare(case, &measure, (component, line), profiles))
        })
        .collect::<Result<Vec<Panel>, MeasureError>>()?;

    // All plots begin equally far from their panel's edge.
    let room = panels.iter().map(|p| p.axes.1.left_room(text)).fold(0.0, f64::max);
    let legend_width = panel - EDGE - room - SIGN - EDGE;
    let row_height = |row: &[Panel]| {
        let legend = row.iter().map(|p| p.legend_lines(text, legend_width).len()).max().unwrap_or(0) as f64;
        1.9 * LABEL + PLOT + BELOW + 8.0 + legend * ROW + 12.0
    };
    let top = title_height(text, title, WIDTH);
    let height: f64 = top + panels.chunks(COLUMNS).map(row_height).sum::<f64>() + EDGE;
    let mut canvas = Canvas::new(WIDTH as u32, height.ceil() as u32);
    draw_title(&mut canvas, text, title, WIDTH);
    let mut y = top;
    for row in panels.chunks(COLUMNS) {
        for (k, one) in row.iter().enumerate() {
            one.draw(&mut canvas, text, DVec2::new(k as f64 * panel, y), panel, room);
        }
        y += row_height(row);
    }
    Ok(canvas)
}

/// The two centrelines and every other line that the case expects something of.
fn wanted(case: &Case) -> Vec<(Component, Line)> {
    let mut lines: Vec<(Component, Line)> = Vec::new();
    let middle = [(Component::U, Line::X(0.5 * case.domain.width)), (Component::V, Line::Y(0.5 * case.domain.height))];
    let expected = case.expect.values().filter_map(|row| Some((row.component?, row.line?)));
    for line in middle.into_iter().chain(expected) {
        if !lines.iter().any(|&known| same(known, line)) {
            lines.push(line);
        }
    }
    lines
}

/// The same component along the same line, to rounding: `0.5 * width` need not be the number that a case gives.
fn same(a: (Component, Line), b: (Component, Line)) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    a.0 == b.0
        && match (a.1, b.1) {
            (Line::X(a), Line::X(b)) | (Line::Y(a), Line::Y(b)) => near(a, b),
            _ => false,
        }
}

fn prepare(
    case: &Case,
    measure: &LineMeasure,
    wanted: (Component, Line),
    profiles: &BTreeMap<String, Profile>,
) -> Panel {
    let (coordinate, value) = measure.samples();
    let curve: Vec<DVec2> = coordinate.iter().copied().zip(value.iter().copied()).map(DVec2::from).collect();
    let mut marks = Vec::new();
    let mut legend = vec![(Sign::Line, "computed".to_owned())];
    let mut colours = CIRCLES.into_iter().cycle();
    let here = |row: &Expectation| row.component.zip(row.line).is_some_and(|here| same(here, wanted));
    for (name, row) in case.expect.iter().filter(|(_, row)| here(row)) {
        let (sign, places, words) = match (measure.measured(row.measure), row.value, profiles.get(name)) {
            (Some(extreme), Some(value), _) => {
                let (sign, word) = match row.measure {
                    Measure::Minimum => (Sign::Minimum, "minimum"),
                    _ => (Sign::Maximum, "maximum"),
                };
                let words = format!("published {word} {} ({})", short(value, 6), row.source);
                (sign, vec![DVec2::new(extreme.position, value)], words)
            }
            (None, _, Some(profile)) => {
                let places = profile.coordinate.iter().copied().zip(profile.value.iter().copied()).map(DVec2::from);
                (Sign::Circle(colours.next().unwrap_or(Rgb::BLACK)), places.collect(), row.source.clone())
            }
            _ => continue,
        };
        marks.push((sign, places));
        legend.push((sign, words));
    }

    let (component, what, unit) = match wanted.0 {
        Component::U => ("u", "u", "m/s"),
        Component::V => ("v", "v", "m/s"),
        Component::P => ("p", "p less its value in the middle,", "Pa"),
        Component::Velocity => ("|u|", "speed", "m/s"),
        Component::Temperature => ("T", "temperature", "K"),
        Component::Tracer => ("c", "tracer", "1"),
        Component::Gradient => ("∇φ", "gradient", "1/m"),
        Component::Laplacian => ("∆φ", "Laplacian", "1/m²"),
        // No line has them.
        Component::X | Component::Y => ("F", "force", "N/m"),
    };
    let (along, heading) = match wanted.1 {
        Line::X(x) => ("y", format!("{what} along x = {} m", short(x, 4))),
        Line::Y(y) => ("x", format!("{what} along y = {} m", short(y, 4))),
    };
    let (low, high) = range(curve.iter().chain(marks.iter().flat_map(|(_, places)| places)).map(|place| place.y));
    let axes = (Axis::new(0.0, measure.length(), 5, along, "m"), Axis::new(low, high, 6, component, unit));
    Panel { heading, axes, curve, legend, marks }
}

/// The range of the values with a margin; a constant still has one.
pub(super) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (-1.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    let margin = if high - low > 1e-9 * size { 0.06 * (high - low) } else { 0.5 * size };
    if margin > 0.0 { (low - margin, high + margin) } else { (-1.0, 1.0) }
}

impl Panel {
    /// Lines of the legend; a line without a sign goes on from the one above.
    fn legend_lines(&self, text: &Text, width: f64) -> Vec<(Option<Sign>, String)> {
        let wrapped = |(sign, words): &(Sign, String)| {
            let sign = *sign;
            let lines = text.wrap(words, LEGEND, width).into_iter().enumerate();
            lines.map(move |(k, line)| ((k == 0).then_some(sign), line)).collect::<Vec<_>>()
        };
        self.legend.iter().flat_map(wrapped).collect()
    }

    /// `room` is what the left side's numbers and label take, pixels.
    fn draw(&self, canvas: &mut Canvas, text: &Text, corner: DVec2, width: f64, room: f64) {
        let low = corner + DVec2::new(EDGE + room, 1.9 * LABEL).ceil();
        let high = DVec2::new(corner.x + width - EDGE - 14.0, low.y + PLOT).floor();
        let frame = Frame { low, high, x: self.axes.0.clone(), y: self.axes.1.clone() };
        let at = DVec2::new(0.5 * (low.x + high.x), corner.y + 0.95 * LABEL);
        text.draw(canvas, &self.heading, at, LABEL, Anchor::Middle, Direction::Rightwards);
        frame.draw_grid(canvas);
        let curve: Vec<DVec2> = self.curve.iter().map(|p| frame.place(p.x, p.y)).collect();
        canvas.polyline(&curve, 2.6, Rgb::BLUE);
        for (sign, places) in &self.marks {
            for place in places {
                sign.draw(canvas, frame.place(place.x, place.y));
            }
        }
        frame.draw(canvas, text);
        let legend_width = width - EDGE - room - SIGN - EDGE;
        for (k, (sign, words)) in self.legend_lines(text, legend_width).iter().enumerate() {
            let middle = DVec2::new(low.x, high.y + BELOW + 8.0 + (k as f64 + 0.5) * ROW);
            if let Some(sign) = sign {
                sign.draw_in_legend(canvas, middle);
            }
            text.draw(canvas, words, middle + SIGN * DVec2::X, LEGEND, Anchor::Start, Direction::Rightwards);
        }
    }
}

impl Sign {
    fn draw(self, canvas: &mut Canvas, at: DVec2) {
        let mut triangle = |tip: f64| {
            let corners = [(0.0, 1.0), (-0.87, -0.5), (0.87, -0.5)].map(|(x, y)| at + 9.0 * DVec2::new(x, tip * y));
            canvas.polygon(&corners, 1.4, Rgb::BLACK, 1.0);
            canvas.polygon(&corners, -1.2, Rgb::WHITE, 1.0);
        };
        match self {
            Self::Line => {}
            Self::Minimum => triangle(1.0),
            Self::Maximum => triangle(-1.0),
            Self::Circle(colour) => {
                canvas.disc(at, 6.5, colour);
                canvas.disc(at, 4.4, Rgb::WHITE);
            }
        }
    }

    fn draw_in_legend(self, canvas: &mut Canvas, start: DVec2) {
        match self {
            Self::Line => canvas.line(start, start + 34.0 * DVec2::X, 2.6, Rgb::BLUE, 1.0),
            other => other.draw(canvas, start + 17.0 * DVec2::X),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_differ_by_rounding_share_a_panel() {
        let u = |x: f64| (Component::U, Line::X(x));
        assert!(same(u(0.1 + 0.2), u(0.3)) && !same(u(0.3), u(0.301)));
        assert!(!same(u(0.3), (Component::V, Line::X(0.3))) && !same(u(0.3), (Component::U, Line::Y(0.3))));
    }

    #[test]
    fn ranges_hold_every_value_and_are_never_empty() {
        assert_eq!(range([].into_iter()), (-1.0, 1.0));
        assert_eq!(range([0.0, 0.0].into_iter()), (-1.0, 1.0));
        assert_eq!(range([2.0].into_iter()), (1.0, 3.0));
        let (low, high) = range([1.0, -1.0, 0.5].into_iter());
        assert!((low + 1.12).abs() < 1e-12 && (high - 1.12).abs() < 1e-12);
    }
}
