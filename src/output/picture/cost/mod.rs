//! cost.png: errors of a study's settings against the seconds they take. One plot of all, with the cheapest setting for
//! each error asked for; where there are several grids, each has a plot of its own below, on the same axes.

mod callout;
mod plot;
mod sign;

use std::path::Path;

use glam::DVec2;

use super::canvas::Canvas;
use super::frame::{BELOW, Frame, LABEL, LEGEND, draw_title, title_height};
use super::text::{Anchor, Direction, Text};
use crate::output::OutputError;
use crate::study::Table;
use plot::{Axes, Group, Plot};
use sign::Sign;

const WIDTH: f64 = 1500.0;
const EDGE: f64 = 18.0;
/// Room for the callouts, right of the first plot.
const CALLOUTS: f64 = 400.0;
/// Heights of the first plot and of the others, pixels.
const FIRST: f64 = 640.0;
const OTHER: f64 = 400.0;
/// Height of a line of a legend, and where its text begins, right of its sign.
const ROW: f64 = 1.5 * LEGEND;
const SIGN: f64 = 46.0;

/// Draws a study's picture.
///
/// # Errors
/// Errors of the file system.
pub fn draw_cost(path: &Path, table: &Table) -> Result<(), OutputError> {
    canvas(&Text::new()?, table).save(path)
}

/// A heading, a plot and its legend.
struct Panel {
    heading: Option<String>,
    groups: Vec<Group>,
    /// Upper left corner and size of the plot, with its heading, without its axes.
    corner: DVec2,
    size: DVec2,
    columns: usize,
}

fn canvas(text: &Text, table: &Table) -> Canvas {
    let axes = Axes::new(table);
    let small = axes.small(table);
    let left = EDGE + axes.error.left_room(text);
    let mut y = title_height(text, &table.title, WIDTH);
    let mut panels = Vec::new();
    let several = table.grids.len() > 1;
    let groups = if several { by_grid(table) } else { by_family(table, 0) };
    let size = DVec2::new(WIDTH - CALLOUTS - left, FIRST);
    y = place(&mut panels, text, Panel { heading: None, groups, corner: DVec2::new(left, y), size, columns: 0 }, y);
    if several {
        for pair in (0..table.grids.len()).collect::<Vec<_>>().chunks(2) {
            let mut bottom = y;
            for (k, &grid) in pair.iter().enumerate() {
                let corner = DVec2::new(0.5 * WIDTH * k as f64 + left, y);
                let size = DVec2::new(0.5 * WIDTH - left - EDGE, OTHER);
                let heading = Some(table.grids[grid].clone());
                let panel = Panel { heading, groups: by_family(table, grid), corner, size, columns: 0 };
                bottom = bottom.max(place(&mut panels, text, panel, y));
            }
            y = bottom;
        }
    }
    let notes = notes(text, table);
    let mut canvas = Canvas::new(WIDTH as u32, (y + notes.len() as f64 * ROW + EDGE).ceil() as u32);
    draw_title(&mut canvas, text, &table.title, WIDTH);
    for (index, panel) in panels.iter().enumerate() {
        let plot = panel.draw(&mut canvas, text, table, if index == 0 { &axes } else { &small });
        if index == 0 {
            callout::draw(&mut canvas, text, &plot, WIDTH - EDGE);
        }
    }
    for (k, line) in notes.iter().enumerate() {
        let at = DVec2::new(left, y + (k as f64 + 0.5) * ROW);
        text.draw(&mut canvas, line, at, LEGEND, Anchor::Start, Direction::Rightwards);
    }
    canvas
}

/// Adds a panel at `y` and returns where it ends.
fn place(panels: &mut Vec<Panel>, text: &Text, panel: Panel, y: f64) -> f64 {
    let panel = panel.with_columns(text);
    let heading = if panel.heading.is_some() { 1.9 * LABEL } else { 0.0 };
    let rows = panel.groups.len().div_ceil(panel.columns.max(1));
    let end = y + heading + panel.size.y + BELOW + 10.0 + rows as f64 * ROW + 22.0;
    panels.push(panel);
    end
}

impl Panel {
    /// As many columns in the legend as fit beside each other.
    fn with_columns(mut self, text: &Text) -> Self {
        // Below the callouts there is room as well.
        let room = if self.heading.is_some() { self.size.x } else { self.size.x + CALLOUTS - EDGE };
        self.heading = self.heading.map(|heading| text.cut(&heading, LABEL, self.size.x));
        for group in &mut self.groups {
            group.name = text.cut(&group.name, LEGEND, room - SIGN);
        }
        self.columns = ((room / self.legend_width(text)) as usize).clamp(1, self.groups.len().max(1));
        self
    }

    fn legend_width(&self, text: &Text) -> f64 {
        SIGN + self.groups.iter().map(|group| text.width(&group.name, LEGEND)).fold(0.0, f64::max) + 26.0
    }

    fn draw<'a>(&'a self, canvas: &mut Canvas, text: &Text, table: &'a Table, axes: &Axes) -> Plot<'a> {
        let mut low = self.corner.round();
        if let Some(heading) = &self.heading {
            let at = low + DVec2::new(0.5 * self.size.x, 0.95 * LABEL);
            text.draw(canvas, heading, at, LABEL, Anchor::Middle, Direction::Rightwards);
            low.y += (1.9 * LABEL).round();
        }
        let frame = Frame { low, high: (low + self.size).round(), x: axes.seconds.clone(), y: axes.error.clone() };
        // Of several grids the first plot shows all: too many lines.
        let lines = self.heading.is_some() || table.grids.len() == 1;
        let plot = Plot { table, frame, groups: &self.groups, lines };
        plot.draw(canvas, text);
        let column = self.legend_width(text);
        for (k, group) in self.groups.iter().enumerate() {
            let (row, along) = (k / self.columns, k % self.columns);
            let offset = DVec2::new(along as f64 * column, BELOW + 10.0 + (row as f64 + 0.5) * ROW);
            let start = DVec2::new(low.x, plot.frame.high.y) + offset;
            match lines {
                true => group.sign.draw_in_legend(canvas, start),
                false => group.sign.draw(canvas, start + 17.0 * DVec2::X),
            }
            text.draw(canvas, &group.name, start + SIGN * DVec2::X, LEGEND, Anchor::Start, Direction::Rightwards);
        }
        plot
    }
}

/// The families of a grid, each a line.
fn by_family(table: &Table, grid: usize) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, row) in table.rows.iter().enumerate().filter(|(_, row)| row.grid == grid) {
        match groups.iter_mut().find(|group| group.name == row.family) {
            Some(group) => group.lines[0].push(index),
            None => {
                let sign = Sign::new(groups.len());
                groups.push(Group { sign, name: row.family.clone(), lines: vec![vec![index]] });
            }
        }
    }
    for group in &mut groups {
        if group.lines[0].iter().all(|&row| table.place(&table.rows[row]).is_none()) {
            group.name += " (none to show)";
        }
    }
    groups
}

fn by_grid(table: &Table) -> Vec<Group> {
    let group = |(grid, label): (usize, &String)| {
        let lines = by_family(table, grid).into_iter().flat_map(|family| family.lines).collect();
        Group { sign: Sign::new(grid), name: label.clone(), lines }
    };
    table.grids.iter().enumerate().map(group).collect()
}

/// What stands below: how to read the picture, what is not in it, where it was made.
fn notes(text: &Text, table: &Table) -> Vec<String> {
    let mut notes = vec![
        "Band: the least error that can be had in the time. Bars: the fastest and the slowest of the repeated runs."
            .to_owned(),
    ];
    let missing = table.rows.iter().filter(|row| table.place(row).is_none()).count();
    if missing > 0 {
        let noun = if missing == 1 { "setting" } else { "settings" };
        notes.push(format!("Not shown: {missing} {noun} without an error, which cost.csv explains."));
    }
    notes.push(format!("{}. Stillpoint {}.", table.ran_on(), table.version));
    notes.iter().flat_map(|note| text.wrap(note, LEGEND, WIDTH - 260.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::table_of;

    const RESULTS: [(Option<f64>, f64); 5] =
        [(Some(0.04), 0.25), (Some(0.012), 1.0), (Some(0.003), 4.0), (None, 9.0), (Some(0.2), 3.0)];

    fn drawn(table: &Table) -> (Vec<u8>, (u32, u32)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cost.png");
        draw_cost(&path, table).unwrap();
        let image = image::ImageReader::open(&path).unwrap().decode().unwrap();
        (std::fs::read(&path).unwrap(), (image.width(), image.height()))
    }

    #[test]
    fn the_picture_shows_errors_spreads_targets_and_machine() {
        let table = table_of(&RESULTS);
        let first = drawn(&table).0;
        assert_eq!(first, drawn(&table).0, "the same table gives the same picture");
        let changed = |change: &dyn Fn(&mut Table)| {
            let mut other = table.clone();
            change(&mut other);
            drawn(&other).0 != first
        };
        assert!(changed(&|table| table.rows[4].error = Some(0.1)));
        assert!(changed(&|table| table.rows[4].cpu.most = 3.7));
        assert!(changed(&|table| table.targets = vec![0.05]));
        assert!(changed(&|table| table.machine = "Another".to_owned()));
        assert!(changed(&|table| table.rows[2].family = "two".to_owned()));
        assert!(!changed(&|table| table.rows[4].wall.most = 11.0), "the other clock is not shown");
    }

    #[test]
    fn each_of_several_grids_has_a_plot_of_its_own() {
        let mut table = table_of(&RESULTS);
        let (_, (width, height)) = drawn(&table);
        table.grids.push("more".to_owned());
        table.rows[3].grid = 1;
        table.rows[4].grid = 1;
        let (_, (same, higher)) = drawn(&table);
        assert!(same == width && f64::from(higher) > f64::from(height) + OTHER, "{height}, then {higher}");
    }

    #[test]
    fn nothing_to_show_is_still_a_picture() {
        for results in [&[][..], &[(None, 1.0)], &[(Some(0.0), 1.0)], &[(Some(1e-12), 1e-3)], &[(Some(0.3), 1e6)]] {
            let (_, (width, height)) = drawn(&table_of(results));
            assert!(width == 1500 && (700..1400).contains(&height), "{results:?}: {width} x {height}");
        }
    }
}
