//! The cheapest setting for each error asked for: a ring with a letter on its mark, and beside the plot what it is.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::colour::Rgb;
use super::super::frame::LEGEND;
use super::super::text::{Anchor, Direction, Text};
use super::super::ticks::short;
use super::plot::{Plot, dashed};

/// Where a callout begins, right of the frame, and how high a line of it is, pixels.
const START: f64 = 40.0;
const ROW: f64 = 1.35 * LEGEND;

struct Callout {
    lines: Vec<String>,
    /// The middle of its first line, pixels from the top.
    y: f64,
    /// Of its guide.
    guide: Option<f64>,
}

/// `right` is the edge of the figure, pixels.
pub fn draw(canvas: &mut Canvas, text: &Text, plot: &Plot<'_>, right: f64) {
    let width = right - plot.frame.high.x - START;
    let mut rings: Vec<(usize, String)> = Vec::new();
    let mut callouts = Vec::new();
    for (&target, letter) in plot.table.targets.iter().zip('A'..='Z') {
        let guide = plot.guide(target);
        let percent = format!("{}%", short(100.0 * target, 3));
        let Some(row) = plot.table.cheapest(target) else {
            callouts.push(Callout { lines: vec![format!("{percent}: none reaches it")], y: 0.0, guide });
            continue;
        };
        match rings.iter_mut().find(|(known, _)| *known == row) {
            Some((_, letters)) => letters.push(letter),
            None => rings.push((row, letter.to_string())),
        }
        let Some((error, seconds)) = plot.table.place(&plot.table.rows[row]) else { continue };
        let mut lines = vec![format!("{letter}  {percent} for {} s", short(seconds.median, 2))];
        let words = plot.table.in_words(&plot.table.rows[row]);
        lines.extend(text.wrap(&words, LEGEND, width));
        lines.push(format!("error {}%", short(100.0 * error, 2)));
        callouts.push(Callout { lines, y: 0.0, guide });
    }
    stack(&mut callouts, plot.frame.low.y, plot.frame.high.y);
    for callout in &callouts {
        let at = DVec2::new(plot.frame.high.x + START, callout.y);
        if let Some(guide) = callout.guide {
            let edge = DVec2::new(plot.frame.high.x, guide);
            dashed(canvas, edge, at - 8.0 * DVec2::X);
        }
        for (k, line) in callout.lines.iter().enumerate() {
            let at = at + k as f64 * ROW * DVec2::Y;
            text.draw(canvas, line, at, LEGEND, Anchor::Start, Direction::Rightwards);
        }
    }
    let marks: Vec<DVec2> = (0..plot.table.rows.len()).filter_map(|row| plot.mark(row)).collect();
    for (row, letters) in rings {
        if let Some(at) = plot.mark(row) {
            ring(canvas, text, plot, at, &letters, &marks);
        }
    }
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
        let nearest = marks.iter().map(|mark| mark.distance(*place)).fold(f64::INFINITY, f64::min).min(40.0);
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
