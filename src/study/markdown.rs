//! cost.md: the study in words and tables.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use super::{Row, Table};
use crate::output::OutputError;
use crate::output::file::write_whole;
use crate::output::picture::short;

pub(super) fn write(path: &Path, table: &Table) -> Result<(), OutputError> {
    write_whole(path, |file| file.write_all(text(table).as_bytes()).map_err(OutputError::io(path)))
}

fn text(table: &Table) -> String {
    let mut text = format!("# {}\n\n![Error against time](cost.png)\n\n", table.title);
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    line(format!("{}. Seconds of {}, median.\n", capital(&table.quantity()), table.seconds.name()));
    line(format!("Machine: {}. Stillpoint {}.\n", table.ran_on(), table.version));
    line(format!("Made by\n\n```sh\n{}\n```\n", table.command));
    line("## The cheapest setting\n".to_owned());
    line("| for an error of at most | setting | seconds | its error |\n|---|---|---|---|".to_owned());
    for &target in &table.targets {
        line(match table.cheapest(target) {
            Some(row) => named(table, &percent(target), &table.rows[row]),
            None => format!("| {} | none reaches it | | |", percent(target)),
        });
    }
    line("\n## The front\n\nNo setting is both faster and more accurate than one of these.\n".to_owned());
    line("| | setting | seconds | error |\n|---|---|---|---|".to_owned());
    for row in table.front() {
        line(named(table, "", &table.rows[row]));
    }
    for (grid, label) in table.grids.iter().enumerate() {
        line(format!("\n## {}\n", capital(label)));
        line("| family | | points | steps | pressure iterations | error | seconds | least to most | setup | solve | other operations | reading | end |".to_owned());
        line("|---|---|---|---|---|---|---|---|---|---|---|---|---|".to_owned());
        for row in table.rows.iter().filter(|row| row.grid == grid) {
            line(full(table, row));
        }
    }
    text
}

fn named(table: &Table, first: &str, row: &Row) -> String {
    let place = table.place(row);
    let seconds = place.map_or(String::new(), |(_, seconds)| plain(seconds.median));
    let error = row.error.map_or(String::new(), percent);
    format!("| {first} | {} | {seconds} | {error} |", table.in_words(row))
}

fn full(table: &Table, row: &Row) -> String {
    let seconds = table.seconds_of(row);
    let maybe = |value: Option<f64>| value.map_or("-".to_owned(), plain);
    let error = row.error.map_or("-".to_owned(), percent);
    let spread = format!("{} to {}", plain(seconds.least), plain(seconds.most));
    let cells = [
        row.family.clone(),
        row.along.clone(),
        row.points.to_string(),
        row.steps.to_string(),
        row.iterations.to_string(),
        error,
        plain(seconds.median),
        spread,
        plain(row.setup),
        maybe(row.solve),
        maybe(row.operations),
        plain(row.reading),
        row.status.clone(),
    ];
    format!("| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | "))
}

pub(crate) fn plain(value: f64) -> String {
    short(value, 3)
}

fn percent(value: f64) -> String {
    format!("{}%", short(100.0 * value, 3))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::table::tests::table;
    use super::*;

    #[test]
    fn the_cheapest_settings_and_the_front_are_named() {
        let text = text(&table(&[(Some(0.04), 0.25), (Some(0.02), 4.0), (Some(0.03), 5.0), (None, 1.0)]));
        let has = |line: &str| assert!(text.lines().any(|known| known == line), "no {line:?} in\n{text}");
        has("| 5% | setting 0 | 0.25 | 4% |");
        has("| 1% | none reaches it | | |");
        has("|  | setting 1 | 4 | 2% |");
        has("stillpoint cost a.toml");
        has("Machine: A Chip, 2 cores, linux, 1 thread used. Stillpoint 0.1.0.");
        assert!(!text.contains("|  | setting 2 |"), "it is beaten");
        assert_eq!(text.matches("| diverged after t = 0.25 s |").count(), 1);
    }
}
