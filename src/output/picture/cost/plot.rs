//! One plot of errors against seconds: the front, the guides, lines and marks.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::colour::Rgb;
use super::super::frame::{Axis, Frame};
use super::super::text::{Anchor, Direction, Text};
use super::sign::Sign;
use crate::study::{Spread, Table};

/// Colours of what stands behind the marks.
const FRONT: Rgb = Rgb([253, 231, 189]);
const GUIDE: Rgb = Rgb([120; 3]);
const MINOR: Rgb = Rgb([244; 3]);
const OTHER: Rgb = Rgb([205; 3]);
/// Size of the names of marks, pixels per em, and where they end, from the mark.
const NAME: f64 = 15.0;
pub const BESIDE: DVec2 = DVec2::new(-13.0, 17.0);
/// Width of the front's band, pixels.
const BAND: f64 = 13.0;

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

    /// The same in few words, for the plots below.
    pub fn small(&self, table: &Table) -> Self {
        let (seconds, error) = (format!("{}, s", table.seconds.name()), "error".to_owned());
        Self {
            seconds: Axis { label: seconds, ..self.seconds.clone() },
            error: Axis { label: error, ..self.error.clone() },
        }
    }
}

/// A plot and what it shows.
pub struct Plot<'a> {
    pub table: &'a Table,
    pub frame: Frame,
    pub groups: &'a [Group],
    /// Whether the marks of a line are joined.
    pub lines: bool,
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

    pub fn draw(&self, canvas: &mut Canvas, text: &Text) {
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
            for line in group.lines.iter().filter(|_| self.lines) {
                let places: Vec<DVec2> = line.iter().filter_map(|&row| self.mark(row)).collect();
                canvas.polyline(&places, 2.4, group.sign.colour.paler(0.25));
            }
            group.lines.iter().flatten().for_each(|&row| self.draw_spread(canvas, row, group.sign.colour));
        }
        for group in self.groups {
            group.lines.iter().flatten().filter_map(|&row| self.mark(row)).for_each(|at| group.sign.draw(canvas, at));
        }
        if self.lines {
            self.draw_names(canvas, text);
        }
        self.frame.draw(canvas, text);
    }

    /// Says beside the marks that none of the same plot beats where on their line they stand: below and left of those there
    /// is nothing else.
    fn draw_names(&self, canvas: &mut Canvas, text: &Text) {
        let mut rows: Vec<(usize, DVec2)> = self
            .groups
            .iter()
            .flat_map(|group| group.lines.concat())
            .filter_map(|row| Some((row, self.mark(row)?)))
            .collect();
        rows.sort_by(|a, b| a.1.x.total_cmp(&b.1.x).then(b.1.y.total_cmp(&a.1.y)));
        let mut lowest = f64::NEG_INFINITY;
        let mut taken: Vec<(DVec2, DVec2)> = Vec::new();
        for &(row, at) in &rows {
            if at.y <= lowest {
                continue;
            }
            lowest = at.y;
            let name = &self.table.rows[row].along;
            let end = at + BESIDE;
            let (low, high) = (end - DVec2::new(text.width(name, NAME), 0.5 * NAME), end + 0.5 * NAME * DVec2::Y);
            let on_mark = rows.iter().any(|(_, mark)| mark.distance(mark.clamp(low, high)) < 13.0);
            let on_name = taken.iter().any(|(other, to)| low.cmplt(*to).all() && other.cmplt(high).all());
            let inside = low.cmpgt(self.frame.low).all() && high.cmplt(self.frame.high).all();
            if inside && !on_mark && !on_name {
                text.draw(canvas, name, end, NAME, Anchor::End, Direction::Rightwards);
                taken.push((low, high));
            }
        }
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
        // Its ends are round.
        let end = 0.5 * BAND;
        let mut stairs = vec![DVec2::new(first.x, self.frame.low.y + end), *first];
        for pair in places.windows(2) {
            stairs.extend([DVec2::new(pair[1].x, pair[0].y), pair[1]]);
        }
        stairs.push(DVec2::new(self.frame.high.x - end, last.y));
        canvas.polyline(&stairs, BAND, FRONT);
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
