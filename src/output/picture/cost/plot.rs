//! One plot of errors against seconds: the front, the guides, lines and marks.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::colour::Rgb;
use super::super::frame::{Axis, Frame};
use super::super::text::Text;
use super::sign::Sign;
use crate::study::{Spread, Table};

/// Colours of what stands behind the marks.
const FRONT: Rgb = Rgb([253, 231, 189]);
const GUIDE: Rgb = Rgb([120; 3]);
const MINOR: Rgb = Rgb([244; 3]);
const OTHER: Rgb = Rgb([205; 3]);

/// Settings that belong together.
#[derive(Debug, Clone)]
pub struct Group {
    pub sign: Sign,
    pub name: String,
    /// Each a line, of places in the table's rows.
    pub lines: Vec<Vec<usize>>,
}

/// The ranges that all plots of a study share: seconds, and errors in percent.
#[derive(Debug, Clone)]
pub struct Axes {
    pub seconds: Axis,
    pub error: Axis,
}

impl Axes {
    pub fn new(table: &Table) -> Self {
        let places: Vec<(f64, Spread)> = table.rows.iter().filter_map(|row| table.place(row)).collect();
        let range = |values: &mut dyn Iterator<Item = f64>, none: (f64, f64)| {
            let ends = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
            if ends.0 > ends.1 { none } else { ends }
        };
        let seconds = &mut places.iter().flat_map(|(_, spread)| [spread.least.max(0.1 * spread.median), spread.most]);
        let (fast, slow) = range(seconds, (0.1, 10.0));
        let (least, most) = range(&mut places.iter().map(|(error, _)| *error), (1e-3, 0.1));
        // Guides that lie near are shown whole.
        let near = table.targets.iter().filter(|target| (0.1 * least..=10.0 * most).contains(*target));
        let (least, most) = near.fold((least, most), |(low, high), target| (low.min(*target), high.max(*target)));
        let name = format!("{} of a whole run, s", table.seconds.name());
        Self {
            seconds: Axis::logarithmic(fast / 1.35, slow * 1.35, &name, ""),
            error: Axis::logarithmic(100.0 * least / 1.6, 100.0 * most * 1.6, &table.quantity(), "%"),
        }
    }
}

/// A plot and what it shows.
pub struct Plot<'a> {
    pub table: &'a Table,
    pub frame: Frame,
    pub groups: &'a [Group],
}

impl Plot<'_> {
    pub fn place(&self, seconds: f64, error: f64) -> DVec2 {
        self.frame.place(seconds.log10(), (100.0 * error).log10())
    }

    /// Where a row stands.
    pub fn mark(&self, row: usize) -> Option<DVec2> {
        self.table.place(&self.table.rows[row]).map(|(error, spread)| self.place(spread.median, error))
    }

    /// The height of the guide for an error, where the plot has it.
    pub fn guide(&self, target: f64) -> Option<f64> {
        let y = self.place(1.0, target).y;
        (self.frame.low.y..=self.frame.high.y).contains(&y).then_some(y)
    }

    pub fn draw(&self, canvas: &mut Canvas, text: &Text, width: f64) {
        self.draw_grid(canvas);
        self.draw_front(canvas);
        for &target in &self.table.targets {
            if let Some(y) = self.guide(target) {
                dashed(canvas, DVec2::new(self.frame.low.x, y), DVec2::new(self.frame.high.x, y));
            }
        }
        let shown: Vec<usize> = self.groups.iter().flat_map(|group| group.lines.concat()).collect();
        for row in (0..self.table.rows.len()).filter(|row| !shown.contains(row)) {
            if let Some(at) = self.mark(row) {
                canvas.disc(at, 4.0, OTHER);
            }
        }
        for group in self.groups {
            for line in &group.lines {
                let places: Vec<DVec2> = line.iter().filter_map(|&row| self.mark(row)).collect();
                canvas.polyline(&places, width, group.sign.colour.paler(0.25));
                line.iter().for_each(|&row| self.draw_spread(canvas, row, group.sign.colour));
            }
        }
        for group in self.groups {
            group.lines.iter().flatten().filter_map(|&row| self.mark(row)).for_each(|at| group.sign.draw(canvas, at));
        }
        self.frame.draw(canvas, text);
    }

    fn draw_grid(&self, canvas: &mut Canvas) {
        let Frame { low, high, x, y } = &self.frame;
        for value in between(x) {
            let at = self.frame.place(value, y.low).x;
            canvas.line(DVec2::new(at, low.y), DVec2::new(at, high.y), 1.0, MINOR, 1.0);
        }
        for value in between(y) {
            let at = self.frame.place(x.low, value).y;
            canvas.line(DVec2::new(low.x, at), DVec2::new(high.x, at), 1.0, MINOR, 1.0);
        }
        self.frame.draw_grid(canvas);
    }

    /// The least error that can be had by each time: a pale band of stairs.
    fn draw_front(&self, canvas: &mut Canvas) {
        let places: Vec<DVec2> = self.table.front().into_iter().filter_map(|row| self.mark(row)).collect();
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return };
        let mut stairs = vec![DVec2::new(first.x, self.frame.low.y), *first];
        for pair in places.windows(2) {
            stairs.extend([DVec2::new(pair[1].x, pair[0].y), pair[1]]);
        }
        stairs.push(DVec2::new(self.frame.high.x, last.y));
        canvas.polyline(&stairs, 13.0, FRONT);
    }

    /// From the fastest to the slowest of the repeated runs.
    fn draw_spread(&self, canvas: &mut Canvas, row: usize, colour: Rgb) {
        let Some((error, spread)) = self.table.place(&self.table.rows[row]) else { return };
        let clamp = |at: DVec2| DVec2::new(at.x.clamp(self.frame.low.x, self.frame.high.x), at.y);
        let ends = [spread.least.max(f64::MIN_POSITIVE), spread.most].map(|seconds| clamp(self.place(seconds, error)));
        canvas.line(ends[0], ends[1], 1.6, colour, 1.0);
        ends.iter().for_each(|end| canvas.line(*end - 5.0 * DVec2::Y, *end + 5.0 * DVec2::Y, 1.6, colour, 1.0));
    }
}

/// Twice to nine times each power of ten, within an axis.
fn between(axis: &Axis) -> Vec<f64> {
    let powers = axis.low.floor() as i32..=axis.high.floor() as i32;
    let values = powers.flat_map(|power| (2..10).map(move |m| f64::from(power) + f64::from(m).log10()));
    values.filter(|value| (axis.low..=axis.high).contains(value)).collect()
}

pub fn dashed(canvas: &mut Canvas, from: DVec2, to: DVec2) {
    let length = from.distance(to);
    let (dash, gap) = (7.0, 5.0);
    for k in 0..(length / (dash + gap)).ceil() as usize {
        let start = k as f64 * (dash + gap);
        let at = |along: f64| from.lerp(to, (along / length).min(1.0));
        canvas.line(at(start), at(start + dash), 1.3, GUIDE, 1.0);
    }
}
