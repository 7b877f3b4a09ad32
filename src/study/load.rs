//! From a study file to its settings, all of them checked before any is run.

use std::path::{Path, PathBuf};

use super::choice::{self, Choice, Varied, is_line};
use super::file::{Clock, Grid, StudyFile};
use super::keys::{KNOBS, STUDY_FILE};
use super::setting::{EngineKind, Knobs, Precision, Setting, Trial, in_words, refuse};
use crate::case::decode::decode;
use crate::case::document::Document;
use crate::case::fault::{Fault, KeyPath, Problem};
use crate::case::load::{Change, explain};
use crate::case::{Case, CaseError, keys, text};
use crate::gpu::adapter::{self, Candidate};
use crate::scene::{Scene, SceneError};

/// A study, ready to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    pub title: String,
    /// What the error is drawn against.
    pub seconds: Clock,
    /// Relative errors for which the cheapest setting is named, the largest first.
    pub targets: Vec<f64>,
    pub repeats: u32,
    /// s
    pub repeat_below: f64,
    /// Their labels.
    pub grids: Vec<String>,
    /// The rows, grid by grid.
    pub settings: Vec<Setting>,
    /// What is run for them.
    pub trials: Vec<Trial>,
}

/// Why a study cannot be run. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    #[error(transparent)]
    File(#[from] CaseError),
    #[error("{}: with {setting}: {source}", path.display())]
    Scene { path: PathBuf, setting: String, source: SceneError },
}

/// Clouds of at most so many points are laid out before the study begins, to see that they can be.
const CHEAP: f64 = 5000.0;
const MOST_REPEATS: u32 = 1000;

impl Study {
    /// Reads and checks a study file, and loads the case of each of its settings. `overrides` are `key=value`, as after
    /// `--set`.
    ///
    /// # Errors
    /// The first thing wrong with the file, with a case, or with a key that it changes; a GPU that is not there.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, StudyError> {
        let mut document = Document::parse(&text::read(path).map_err(CaseError::from)?, path)?;
        overrides.iter().try_for_each(|given| document.set(given))?;
        let file = decode::<StudyFile>(document.root()).and_then(|file| check(&file).map(|()| file));
        let mut file = file.map_err(|fault| explain(fault, &document, &STUDY_FILE))?;
        file.targets.sort_by(|a, b| b.total_cmp(a));
        let mut loader =
            Loader { path, document: &document, settings: Vec::new(), trials: Vec::new(), gpus: Vec::new() };
        let plans = loader.plans(&file).map_err(|fault| explain(fault, &document, &STUDY_FILE))?;
        for (index, plan) in plans.iter().enumerate() {
            loader.expand(index, plan)?;
        }
        let Loader { settings, trials, .. } = loader;
        let on_gpu = trials.iter().any(|trial| trial.engine == EngineKind::Gpu);
        Ok(Self {
            title: file.title,
            seconds: file.seconds.unwrap_or(if on_gpu { Clock::Wall } else { Clock::Cpu }),
            targets: file.targets,
            repeats: file.repeats,
            repeat_below: file.repeat_below,
            grids: plans.into_iter().map(|plan| plan.label).collect(),
            settings,
            trials,
        })
    }
}

fn check(file: &StudyFile) -> Result<(), Fault> {
    let require = |holds: bool, key: &str| if holds { Ok(()) } else { Err(Fault::range(key)) };
    require(is_line(&file.title), "title")?;
    require((1..=MOST_REPEATS).contains(&file.repeats), "repeats")?;
    require(file.repeat_below >= 0.0, "repeat_below")?;
    require(file.most_runs >= 1, "most_runs")?;
    require(file.targets.iter().all(|target| *target > 0.0), "targets")
}

/// A grid with all that holds for it.
struct Plan {
    label: String,
    case: (PathBuf, KeyPath),
    error: (String, KeyPath),
    set: Vec<Change>,
    /// The last one runs along the lines of the picture, if `lines`.
    varied: Vec<Varied>,
    lines: bool,
}

struct Loader<'a> {
    path: &'a Path,
    document: &'a Document,
    settings: Vec<Setting>,
    trials: Vec<Trial>,
    /// Those already looked up, by the name that was asked for.
    gpus: Vec<(Option<String>, Candidate)>,
}

impl Loader<'_> {
    /// The grids of a file; refused where they ask for too many runs.
    fn plans(&self, file: &StudyFile) -> Result<Vec<Plan>, Fault> {
        let at = |index: usize| vec!["grid".to_owned(), format!("[{index}]")];
        let plans = match &file.grid[..] {
            [] => vec![self.plan(file, &Grid { along: file.along.clone(), ..Grid::default() }, &[], "all settings")?],
            grids => {
                let plan =
                    |(index, grid): (usize, &Grid)| self.plan(file, grid, &at(index), &format!("grid {}", index + 1));
                grids.iter().enumerate().map(plan).collect::<Result<_, _>>()?
            }
        };
        let count = |plan: &Plan| plan.varied.iter().map(|varied| varied.choices.len() as f64).product::<f64>();
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
    fn plan(&self, file: &StudyFile, grid: &Grid, at: &[String], name: &str) -> Result<Plan, Fault> {
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
        let mut set = choice::settings(&file.set, &top("set"), self.document);
        let mut varied = choice::varied(&file.vary, &top("vary"), self.document)?;
        if !at.is_empty() {
            let own_set = choice::settings(&grid.set, &own("set"), self.document);
            let own_varied = choice::varied(&grid.vary, &own("vary"), self.document)?;
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
        Ok(Plan { label, case, error, set, varied, lines })
    }

    /// Adds every combination of a grid.
    fn expand(&mut self, grid: usize, plan: &Plan) -> Result<(), StudyError> {
        let count = plan.varied.iter().map(|varied| varied.choices.len()).product();
        for number in 0..count {
            let mut rest = number;
            let mut chosen: Vec<(&Varied, &Choice)> = Vec::new();
            for varied in plan.varied.iter().rev() {
                chosen.push((varied, &varied.choices[rest % varied.choices.len()]));
                rest /= varied.choices.len();
            }
            chosen.reverse();
            self.add(grid, plan, &chosen)?;
        }
        Ok(())
    }

    fn add(&mut self, grid: usize, plan: &Plan, chosen: &[(&Varied, &Choice)]) -> Result<(), StudyError> {
        let mut changes = plan.set.clone();
        for (k, (varied, choice)) in chosen.iter().enumerate() {
            for change in &choice.changes {
                let same = |other: &&(&Varied, &Choice)| other.1.changes.iter().any(|known| known.key == change.key);
                if let Some((other, _)) = chosen[..k].iter().find(same) {
                    let reason = format!("is varied by {} and by {}", other.key(), varied.key());
                    return Err(refuse(&change.key.join("."), Some(&change.value), &change.place, reason).into());
                }
                changes.push(change.clone());
            }
        }
        let words = |parts: &[(&Varied, &Choice)]| {
            parts.iter().map(|(varied, choice)| in_words(&varied.key(), &choice.value)).collect::<Vec<_>>().join(", ")
        };
        let family = if plan.lines { &chosen[..chosen.len() - 1] } else { chosen };
        let family = if family.is_empty() { plan.label.clone() } else { words(family) };
        let words = words(chosen);
        let trial = self.trial(plan, changes, &words)?;
        let known = self.trials.iter().position(|known| *known == trial);
        let trial = known.unwrap_or_else(|| {
            self.trials.push(trial);
            self.trials.len() - 1
        });
        let values = chosen.iter().map(|(varied, choice)| (varied.key(), choice.value.clone())).collect();
        self.settings.push(Setting { grid, values, family, words, trial });
        Ok(())
    }

    fn trial(&mut self, plan: &Plan, mut changes: Vec<Change>, words: &str) -> Result<Trial, StudyError> {
        let fault = |path: &[String], reason: String| explain(Fault::at(path, reason), self.document, &STUDY_FILE);
        let knobs = Knobs::take(&mut changes)?;
        if let Some(Change { key, place, .. }) = changes.iter().find(|change| change.key.len() == 1) {
            let near =
                keys::closest(&key[0], &KNOBS).map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
            let reason = format!(
                "no such key{near}; there are {}, those of a case's tables, and names of lists of tables",
                KNOBS.join(", ")
            );
            return Err(refuse(&key[0], None, place, reason).into());
        }
        let path = self.path.parent().unwrap_or(Path::new("")).join(&plan.case.0);
        let mut case = Case::load_changed(&path, &changes).map_err(|error| match error {
            CaseError::Text(error) => fault(&plan.case.1, error.to_string()),
            error => error,
        })?;
        let (error, at) = &plan.error;
        if !case.expect.contains_key(error) {
            let known: Vec<&str> = case.expect.keys().map(String::as_str).collect();
            let near = keys::closest(error, &known).map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
            let reason = format!("{} has no [expect.{error}]{near}; it has {}", path.display(), known.join(", "));
            return Err(fault(at, reason).into());
        }
        case.expect.retain(|name, _| name == error);
        let trial = self.on_engine(case, knobs)?;
        self.try_cloud(&trial.case, words)?;
        Ok(trial)
    }

    fn on_engine(&mut self, case: Case, knobs: Knobs) -> Result<Trial, CaseError> {
        let engine = knobs.engine.as_ref().map_or(EngineKind::Cpu, |(engine, _)| *engine);
        let precision = knobs.precision.as_ref().map(|(precision, _)| *precision);
        let threads = knobs.threads.map_or(1, |(threads, _)| threads);
        let asked = knobs.adapter;
        if engine == EngineKind::Cpu {
            if let Some((name, place)) = &asked {
                let reason = "names a GPU, and engine is \"cpu\"; leave it out".to_owned();
                return Err(refuse("adapter", Some(&name.as_str().into()), place, reason));
            }
            let precision = precision.unwrap_or(Precision::F64);
            return Ok(Trial { case, engine, precision, adapter: None, threads });
        }
        let name = asked.as_ref().map(|(name, _)| name.clone());
        let gpu = match self.gpus.iter().find(|(known, _)| *known == name) {
            Some((_, gpu)) => gpu.clone(),
            None => {
                let found = adapter::choose(name.as_deref()).map_err(|error| match (&asked, &knobs.engine) {
                    (Some((name, place)), _) => {
                        refuse("adapter", Some(&name.as_str().into()), place, error.to_string())
                    }
                    (None, Some((_, place))) => refuse("engine", Some(&"gpu".into()), place, error.to_string()),
                    (None, None) => refuse("engine", None, &self.document.place(&[]), error.to_string()),
                })?;
                self.gpus.push((name, found.clone()));
                found
            }
        };
        let adapter = Some(gpu.info.name.clone());
        match knobs.precision {
            Some((Precision::F64, place)) if !gpu.double_precision => {
                let reason = format!("{} has no f64 in shaders; allowed: \"f32\"", gpu.info.name);
                Err(refuse("precision", Some(&"f64".into()), &place, reason))
            }
            _ => Ok(Trial { case, engine, precision: precision.unwrap_or(Precision::F32), adapter, threads }),
        }
    }

    /// Lays out the points of a small case, unless one with the same points was.
    fn try_cloud(&self, case: &Case, words: &str) -> Result<(), StudyError> {
        let same =
            |known: &Case| (&known.domain, &known.cloud, &known.method) == (&case.domain, &case.cloud, &case.method);
        if case.point_estimate() > CHEAP || self.trials.iter().any(|trial| same(&trial.case)) {
            return Ok(());
        }
        let failed = |source| StudyError::Scene { path: self.path.to_owned(), setting: words.to_owned(), source };
        Scene::build(case).map(|_| ()).map_err(failed)
    }
}
