//! A study's results: a row a setting, the front that none of them beats, and the cheapest for an error.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::{Clock, Machine, Run, RunSeconds, Setting, Study};

/// All that is written and drawn of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Table {
    pub title: String,
    /// The command that makes it again.
    pub command: String,
    pub version: String,
    pub machine: String,
    /// The GPUs that took part.
    pub adapters: Vec<String>,
    /// Threads of the CPU engine.
    pub threads: Vec<usize>,
    /// What the error is of, in words: `minimum of u along x = 0.5`.
    pub errors: Vec<String>,
    pub seconds: Clock,
    pub targets: Vec<f64>,
    pub grids: Vec<String>,
    /// The varied keys, columns of the tables.
    pub keys: Vec<String>,
    pub rows: Vec<Row>,
}

/// A setting and what it gave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its place among the table's grids.
    pub grid: usize,
    /// One for each of the table's keys; empty where the grid does not vary it.
    pub values: Vec<String>,
    pub family: String,
    /// Where it stands on its family's line, in words.
    pub along: String,
    /// All that is varied, in words.
    pub words: String,
    pub points: usize,
    pub steps: u64,
    pub iterations: u64,
    /// Relative; none where the run did not come to its end or the measure is no finite number.
    pub error: Option<f64>,
    pub wall: Spread,
    pub cpu: Spread,
    /// Of all operations of the engine; zeros where it takes no times.
    pub engine: Spread,
    /// Medians, s.
    pub setup: f64,
    pub stepping: f64,
    pub solve: Option<f64>,
    pub operations: Option<f64>,
    pub reading: f64,
    /// Runs that count; none where the study was stopped before.
    pub runs: usize,
    pub status: String,
}

fn row(study: &Study, setting: &Setting, keys: &[String], runs: &[Run]) -> Row {
    let counted = study.counted(runs);
    let last = counted.last();
    let value = |key: &String| setting.values.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone());
    let seconds = |of: fn(&RunSeconds) -> f64| Spread::of(counted.iter().map(|run| of(&run.seconds)));
    let part = |of: fn(&RunSeconds) -> Option<f64>| {
        let times: Option<Vec<f64>> = counted.iter().map(|run| of(&run.seconds)).collect();
        times.filter(|times| !times.is_empty()).map(|times| Spread::of(times.into_iter()).median)
    };
    Row {
        grid: setting.grid,
        values: keys.iter().map(|key| value(key).unwrap_or_default()).collect(),
        family: setting.family.clone(),
        along: setting.along.clone(),
        words: setting.words.clone(),
        points: last.map_or(0, |run| run.points),
        steps: last.map_or(0, |run| run.steps),
        iterations: last.map_or(0, |run| run.iterations),
        error: last.and_then(|run| run.error),
        wall: seconds(|seconds| seconds.wall),
        cpu: seconds(|seconds| seconds.cpu),
        engine: seconds(|seconds| seconds.engine.unwrap_or(0.0)),
        setup: seconds(|seconds| seconds.setup).median,
        stepping: seconds(|seconds| seconds.stepping).median,
        solve: part(|seconds| seconds.solve),
        operations: part(|seconds| seconds.operations),
        reading: seconds(|seconds| seconds.reading).median,
        runs: counted.len(),
        status: last.map_or("not run".to_owned(), |run| run.end.to_string()),
    }
}

/// s
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    pub median: f64,
    pub least: f64,
    pub most: f64,
}

/// Smaller errors, which are rounding, count as this one: a logarithmic axis has no zero.
const LEAST: f64 = 1e-16;

impl Spread {
    /// Of some numbers; zeros of none.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_by(f64::total_cmp);
        let (Some(&least), Some(&most)) = (sorted.first(), sorted.last()) else { return Self::default() };
        let half = sorted.len() / 2;
        let median = if sorted.len() % 2 == 1 { sorted[half] } else { 0.5 * (sorted[half - 1] + sorted[half]) };
        Self { median, least, most }
    }
}

impl Table {
    /// What the runs of a study's trials gave. `command` is the one that makes the study again.
    pub fn new(study: &Study, runs: &[Vec<Run>], machine: &Machine, command: String) -> Self {
        let distinct = |values: &mut dyn Iterator<Item = String>| {
            let mut list: Vec<String> = Vec::new();
            values.for_each(|value| {
                if !list.contains(&value) {
                    list.push(value);
                }
            });
            list
        };
        let keys = study.settings.iter().flat_map(|setting| setting.values.iter().map(|(key, _)| key.clone()));
        let keys = distinct(&mut keys.into_iter());
        let quantities = runs.iter().flatten().filter_map(|run| run.quantity.clone());
        Self {
            title: study.title.clone(),
            command,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: machine.to_string(),
            adapters: distinct(&mut study.trials.iter().filter_map(|trial| trial.adapter.clone())),
            threads: study.trials.iter().map(|trial| trial.threads).collect::<BTreeSet<_>>().into_iter().collect(),
            errors: distinct(&mut quantities.into_iter()),
            seconds: study.seconds,
            targets: study.targets.clone(),
            grids: study.grids.clone(),
            rows: study.settings.iter().map(|setting| row(study, setting, &keys, &runs[setting.trial])).collect(),
            keys,
        }
    }
    /// The seconds that count.
    pub fn seconds_of(&self, row: &Row) -> Spread {
        match self.seconds {
            Clock::Cpu => row.cpu,
            Clock::Wall => row.wall,
            Clock::Engine => row.engine,
        }
    }

    /// The error and the seconds of a row, where it can stand in a picture.
    pub fn place(&self, row: &Row) -> Option<(f64, Spread)> {
        let spread = self.seconds_of(row);
        let error = row.error?.max(LEAST);
        (spread.median > 0.0).then_some((error, spread))
    }

    /// The rows that no other beats in both error and seconds, by ascending seconds.
    pub fn front(&self) -> Vec<usize> {
        let mut order = self.placed();
        order.sort_by(|a, b| a.2.total_cmp(&b.2).then(a.1.total_cmp(&b.1)));
        let mut front = Vec::new();
        let mut least = f64::INFINITY;
        for (row, error, _) in order {
            if error < least {
                least = error;
                front.push(row);
            }
        }
        front
    }

    /// The row with the fewest seconds of those whose error is at most this.
    pub fn cheapest(&self, error: f64) -> Option<usize> {
        let good = self.placed().into_iter().filter(|(_, found, _)| *found <= error);
        good.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(row, ..)| row)
    }

    /// What the errors are of, in words.
    pub fn quantity(&self) -> String {
        match &self.errors[..] {
            [one] if one.starts_with("error of") => format!("relative {one}"),
            [one] => format!("relative error of the {one}"),
            _ => "relative error".to_owned(),
        }
    }

    /// The processor, the threads that were used, the GPUs.
    pub fn ran_on(&self) -> String {
        let threads = self.threads.iter().map(usize::to_string).collect::<Vec<_>>().join(" and ");
        let noun = if self.threads == [1] { "thread" } else { "threads" };
        let gpus: String = self.adapters.iter().map(|name| format!(", {name}")).collect();
        format!("{}, {threads} {noun} used{gpus}", self.machine)
    }

    /// A row in words, with its grid where there are several.
    pub fn in_words(&self, row: &Row) -> String {
        match self.grids.len() {
            1 => row.words.clone(),
            _ => format!("{}: {}", self.grids[row.grid], row.words),
        }
    }

    /// Row, error, seconds.
    fn placed(&self) -> Vec<(usize, f64, f64)> {
        let place = |(index, row)| self.place(row).map(|(error, spread)| (index, error, spread.median));
        self.rows.iter().enumerate().filter_map(place).collect()
    }
}

impl Clock {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Clock::Cpu => "CPU time",
            Clock::Wall => "wall-clock time",
            Clock::Engine => "time of the operations",
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A table with one grid, from errors and seconds.
    pub(crate) fn table(results: &[(Option<f64>, f64)]) -> Table {
        let row = |(k, (error, seconds)): (usize, &(Option<f64>, f64))| Row {
            grid: 0,
            values: vec![k.to_string()],
            family: "one".to_owned(),
            along: format!("1/{k}"),
            words: format!("setting {k}"),
            points: 25,
            steps: 100,
            iterations: 700,
            error: *error,
            wall: Spread { median: 2.0 * seconds, least: *seconds, most: 3.0 * seconds },
            cpu: Spread { median: *seconds, least: 0.9 * seconds, most: 1.2 * seconds },
            engine: Spread { median: 0.5 * seconds, least: 0.25 * seconds, most: *seconds },
            setup: 0.01,
            stepping: 0.5,
            solve: Some(0.25),
            operations: None,
            reading: 0.001,
            runs: 3,
            status: if error.is_some() { "steady".to_owned() } else { "diverged after t = 0.25 s".to_owned() },
        };
        Table {
            title: "A study".to_owned(),
            command: "stillpoint cost a.toml".to_owned(),
            version: "0.1.0".to_owned(),
            machine: "A Chip, 2 cores, linux".to_owned(),
            adapters: Vec::new(),
            threads: vec![1],
            errors: vec!["minimum of u along x = 0.5".to_owned()],
            seconds: Clock::Cpu,
            targets: vec![0.05, 0.01],
            grids: vec!["all settings".to_owned()],
            keys: vec!["cloud.spacing".to_owned()],
            rows: results.iter().enumerate().map(row).collect(),
        }
    }

    #[test]
    fn the_front_has_what_nothing_beats() {
        let results =
            [(Some(0.01), 4.0), (Some(0.1), 1.0), (Some(0.2), 2.0), (None, 0.1), (Some(0.002), 9.0), (Some(0.01), 5.0)];
        assert_eq!(table(&results).front(), [1, 0, 4]);
        assert_eq!(table(&[(Some(0.1), 1.0), (Some(0.05), 1.0)]).front(), [1], "as fast and better");
        assert_eq!(table(&[(None, 1.0)]).front(), [0_usize; 0]);
    }

    #[test]
    fn the_cheapest_is_the_fastest_of_those_that_are_good_enough() {
        let results = [(Some(0.01), 4.0), (Some(0.1), 1.0), (Some(0.04), 2.0), (None, 0.1), (Some(0.002), 9.0)];
        let table = table(&results);
        assert_eq!([0.05, 0.01, 0.002, 0.001].map(|target| table.cheapest(target)), [Some(2), Some(0), Some(4), None]);
        let wall = Table { seconds: Clock::Wall, ..table };
        let doubled = wall.place(&wall.rows[0]).expect("a place").1.median;
        assert_eq!(doubled, 8.0, "wall-clock time counts where it is asked for");
    }

    #[test]
    fn the_spread_is_the_median_and_the_ends() {
        let spread = |values: &[f64]| {
            let Spread { median, least, most } = Spread::of(values.iter().copied());
            (median, least, most)
        };
        assert_eq!(spread(&[3.0, 1.0, 9.0]), (3.0, 1.0, 9.0));
        assert_eq!(spread(&[4.0, 2.0]), (3.0, 2.0, 4.0));
        assert_eq!(spread(&[]), (0.0, 0.0, 0.0));
    }
}
