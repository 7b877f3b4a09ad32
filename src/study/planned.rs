//! The grids of a study file, each with all that holds for it.

use std::path::PathBuf;

use super::choice::{self, Varied, is_line};
use super::file::{Grid, StudyFile};
use crate::case::document::Document;
use crate::case::fault::{Fault, KeyPath, Problem};
use crate::case::load::Change;

/// A grid with all that holds for it.
#[derive(Debug)]
pub(super) struct Planned {
    pub label: String,
    /// Each with the key that gives it.
    pub case: (PathBuf, KeyPath),
    pub error: (String, KeyPath),
    pub set: Vec<Change>,
    /// The last one runs along the lines of the picture, if `lines`.
    pub varied: Vec<Varied>,
    pub lines: bool,
}

/// The grids of a file; refused where they ask for too many runs.
pub(super) fn plan_all(file: &StudyFile, document: &Document) -> Result<Vec<Planned>, Fault> {
    let at = |index: usize| vec!["grid".to_owned(), format!("[{index}]")];
    let plans = match &file.grid[..] {
        [] => vec![plan(document, file, &Grid { along: file.along.clone(), ..Grid::default() }, &[], "all settings")?],
        grids => {
            let each =
                |(index, grid): (usize, &Grid)| plan(document, file, grid, &at(index), &format!("grid {}", index + 1));
            grids.iter().enumerate().map(each).collect::<Result<_, _>>()?
        }
    };
    let count = |plan: &Planned| plan.varied.iter().map(|varied| varied.choices.len() as f64).product::<f64>();
    let settings: f64 = plans.iter().map(count).sum();
    let runs = settings * f64::from(1 + file.repeats);
    if runs > f64::from(file.most_runs) {
        let each = format!("{settings} settings, each run once to warm up and {} times to be timed", file.repeats);
        return Err(Fault::reason(
            "most_runs",
            format!("the study asks for {runs} runs: {each}; vary less, or raise it"),
        ));
    }
    Ok(plans)
}

/// `at` is where the grid stands in the file; nowhere for the one grid of a file without any.
fn plan(document: &Document, file: &StudyFile, grid: &Grid, at: &[String], name: &str) -> Result<Planned, Fault> {
    let own = |key: &str| [at, &[key.to_owned()]].concat();
    let top = |key: &str| vec![key.to_owned()];
    let label = grid.label.clone().unwrap_or_else(|| name.to_owned());
    if !is_line(&label) {
        return Err(Fault { path: own("label"), problem: Problem::Range });
    }
    let case = match (&grid.case, &file.case) {
        (Some(case), _) => (case.clone(), own("case")),
        (None, Some(case)) => (case.clone(), top("case")),
        (None, None) => return Err(Fault::missing("case")),
    };
    let error = match (&grid.error, &file.error) {
        (Some(error), _) => (error.clone(), own("error")),
        (None, Some(error)) => (error.clone(), top("error")),
        (None, None) => return Err(Fault::missing("error")),
    };
    let mut set = choice::settings(&file.set, &top("set"), document);
    let mut varied = choice::varied(&file.vary, &top("vary"), document)?;
    if !at.is_empty() {
        let own_set = choice::settings(&grid.set, &own("set"), document);
        let own_varied = choice::varied(&grid.vary, &own("vary"), document)?;
        varied.retain(|general| {
            let set = own_set.iter().any(|change| change.key == general.name);
            !set && own_varied.iter().all(|special| special.name != general.name)
        });
        set.extend(own_set);
        varied.extend(own_varied);
    }
    if varied.is_empty() {
        return Err(Fault { path: own("vary"), problem: Problem::Missing });
    }
    let names = varied.iter().map(Varied::key).collect::<Vec<_>>();
    let along = match &grid.along {
        Some(along) if !names.contains(along) => {
            return Err(Fault::at(&own("along"), format!("must be a key that is varied: {}", names.join(", "))));
        }
        Some(along) => along.clone(),
        None => {
            let general = file.along.clone().filter(|along| names.contains(along));
            general.unwrap_or_else(|| "cloud.spacing".to_owned())
        }
    };
    varied.sort_by_key(|one| (one.key() == along, one.key()));
    let lines = names.contains(&along);
    Ok(Planned { label, case, error, set, varied, lines })
}
