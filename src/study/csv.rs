//! cost.csv: one row a setting.

use std::io::Write;
use std::path::Path;

use super::{Row, Table};
use crate::output::OutputError;
use crate::output::file::write_whole;

/// The columns behind the varied keys. Times in s, medians unless they say otherwise.
const COLUMNS: &str = "points,steps,pressure_iterations,error,cpu_s,cpu_least_s,cpu_most_s,wall_s,wall_least_s,\
                       wall_most_s,engine_s,engine_least_s,engine_most_s,setup_s,stepping_s,solve_s,operations_s,reading_s,runs,status";

pub(super) fn write(path: &Path, table: &Table) -> Result<(), OutputError> {
    write_whole(path, |file| file.write_all(text(table).as_bytes()).map_err(OutputError::io(path)))
}

fn text(table: &Table) -> String {
    let keys: Vec<String> = table.keys.iter().map(|key| cell(key)).collect();
    let header = [&["grid".to_owned()][..], &keys, &[COLUMNS.to_owned()]].concat().join(",");
    let rows = table.rows.iter().map(|row| line(table, row));
    [header].into_iter().chain(rows).map(|line| line + "\n").collect()
}

fn line(table: &Table, row: &Row) -> String {
    let number = |value: f64| format!("{value:?}");
    let maybe = |value: Option<f64>| value.map(number).unwrap_or_default();
    let mut cells = vec![cell(&table.grids[row.grid])];
    cells.extend(row.values.iter().map(|value| cell(value)));
    cells.extend([row.points as u64, row.steps, row.iterations].map(|count| count.to_string()));
    cells.push(maybe(row.error));
    cells.extend(
        [row.cpu, row.wall, row.engine].iter().flat_map(|time| [time.median, time.least, time.most].map(number)),
    );
    cells.extend([row.setup, row.stepping].map(number));
    cells.extend([row.solve, row.operations].map(maybe));
    cells.extend([number(row.reading), row.runs.to_string(), cell(&row.status)]);
    cells.join(",")
}

/// In quotes where it has to be.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::super::table::tests::table;
    use super::*;

    #[test]
    fn every_row_has_a_cell_for_each_column() {
        let mut table = table(&[(Some(0.01), 4.0), (None, 0.5)]);
        table.rows[1].status = "failed: a \"quoted\", listed reason".to_owned();
        let text = text(&table);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], format!("grid,cloud.spacing,{COLUMNS}"));
        assert_eq!(
            lines[1],
            "all settings,0,25,100,700,0.01,4.0,3.6,4.8,8.0,4.0,12.0,2.0,1.0,4.0,0.01,0.5,0.25,,0.001,3,steady"
        );
        assert_eq!(lines[1].split(',').count(), lines[0].split(',').count());
        assert!(lines[2].starts_with("all settings,1,25,100,700,,0.5,"), "{}", lines[2]);
        assert!(lines[2].ends_with(",3,\"failed: a \"\"quoted\"\", listed reason\""), "{}", lines[2]);
    }
}
