//! The cheapest setting for each error asked for: a ring with a letter on its mark, and beside the plot what it is.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::colour::Rgb;
use super::super::frame::LEGEND;
use super::super::text::{Anchor, Direction, Text};
use super::super::ticks::short;
use super::plot::{BESIDE, Plot, dashed};

/// Where a callout begins, right of the frame, and how high a line of it is, pixels.
const START: f64 = 40.0;
const ROW: f64 = 1.35 * LEGEND;
/// Room for a callout's letter and sign.
const INDENT: f64 = 24.0;

struct Callout {
    row: Option<usize>,
    lines: Vec<String>,
    /// The middle of its first line, pixels from the top.
    y: f64,
    /// Of its guide; of several, the lowest.
    guide: Option<f64>,
}

/// `right` is the edge of the figure, pixels.
pub fn draw(canvas: &mut Canvas, text: &Text, plot: &Plot<'_>, right: f64) {
    let left = plot.frame.high.x + START;
    let mut callouts = callouts(text, plot, right - left);
    stack(&mut callouts, plot.frame.low.y, plot.frame.high.y);
    let marks: Vec<DVec2> = (0..plot.table.rows.len()).filter_map(|row| plot.mark(row)).collect();
    let mut letters = 'A'..='Z';
    for callout in &callouts {
        let at = DVec2::new(left, callout.y);
        if let Some(guide) = callout.guide {
            dashed(canvas, DVec2::new(plot.frame.high.x, guide), at - 8.0 * DVec2::X);
        }
        for (k, line) in callout.lines.iter().enumerate() {
            let at = at + DVec2::new(if callout.row.is_some() { INDENT } else { 0.0 }, k as f64 * ROW);
            text.draw(canvas, line, at, LEGEND, Anchor::Start, Direction::Rightwards);
        }
        let Some(row) = callout.row else { continue };
        let letter = letters.next().unwrap_or('Z').to_string();
        text.draw(canvas, &letter, at, LEGEND, Anchor::Start, Direction::Rightwards);
        if let Some(group) = plot.groups.iter().find(|group| group.lines.iter().flatten().any(|known| *known == row)) {
            group.sign.draw(canvas, at + DVec2::new(6.0, ROW));
        }
        if let Some(at) = plot.mark(row) {
            ring(canvas, text, plot, at, &letter, &marks);
        }
    }
}

/// One for each error asked for; those with the same cheapest setting share theirs.
fn callouts(text: &Text, plot: &Plot<'_>, width: f64) -> Vec<Callout> {
    let percent = |value: f64, digits| format!("{}%", short(100.0 * value, digits));
    let mut shared: Vec<(Option<usize>, Vec<f64>)> = Vec::new();
    for &target in &plot.table.targets {
        let row = plot.table.cheapest(target);
        match shared.last_mut() {
            Some((known, targets)) if *known == row => targets.push(target),
            _ => shared.push((row, vec![target])),
        }
    }
    let callout = |(row, targets): (Option<usize>, Vec<f64>)| {
        let guide = targets.iter().rev().find_map(|&target| plot.guide(target));
        let targets = targets.iter().map(|&target| percent(target, 3)).collect::<Vec<_>>().join(", ");
        let found = row.map(|row| &plot.table.rows[row]).and_then(|row| Some((row, plot.table.place(row)?)));
        let lines = match found {
            None => text.wrap(&format!("{targets}: no setting reaches it"), LEGEND, width),
            Some((row, (error, seconds))) => {
                let mut lines = vec![format!("{targets} in {} s", short(seconds.median, 2))];
                lines.extend(text.wrap(&plot.table.in_words(row), LEGEND, width - INDENT));
                lines.push(format!("error {}", percent(error, 2)));
                lines
            }
        };
        Callout { row, lines, y: 0.0, guide }
    };
    shared.into_iter().map(callout).collect()
}

/// Puts each callout beside its guide, or as near as those above and below it and the ends of the plot allow.
fn stack(callouts: &mut [Callout], top: f64, bottom: f64) {
    let height = |callout: &Callout| callout.lines.len() as f64 * ROW + 0.6 * ROW;
    let mut free = top + 0.5 * ROW;
    for callout in callouts.iter_mut() {
        callout.y = callout.guide.unwrap_or(free).max(free);
        free = callout.y + height(callout);
    }
    let mut end = bottom;
    for callout in callouts.iter_mut().rev() {
        callout.y = callout.y.min(end - height(callout) + ROW);
        end = callout.y - 0.5 * ROW;
    }
}

/// A ring around a mark, with letters where the fewest other marks are.
fn ring(canvas: &mut Canvas, text: &Text, plot: &Plot<'_>, at: DVec2, letters: &str, marks: &[DVec2]) {
    let turns: Vec<DVec2> =
        (0..=48).map(|k| at + 15.0 * DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 48.0)).collect();
    canvas.polyline(&turns, 2.2, Rgb::BLACK);
    let size = DVec2::new(text.width(letters, LEGEND), LEGEND);
    let places = (0..16)
        .map(|k| at + (25.0 + 0.5 * size.x) * DVec2::from_angle((f64::from(k) - 3.0) * std::f64::consts::TAU / 16.0));
    let room = |place: &DVec2| {
        let name = at + BESIDE - 12.0 * DVec2::X;
        let nearest = marks.iter().chain([&name]).map(|mark| mark.distance(*place)).fold(40.0, f64::min);
        let inside = place.cmpgt(plot.frame.low + 14.0).all() && place.cmplt(plot.frame.high - 14.0).all();
        if inside { nearest } else { nearest - 1000.0 }
    };
    let place = places.fold((f64::NEG_INFINITY, at), |best, place| {
        let room = room(&place);
        if room > best.0 + 1e-9 { (room, place) } else { best }
    });
    canvas.disc(place.1, 0.62 * size.x.max(LEGEND), Rgb::WHITE);
    text.draw(canvas, letters, place.1, LEGEND, Anchor::Middle, Direction::Rightwards);
}
