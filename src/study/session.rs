//! The runs of a study, in turns: all trials once, then all again, so that a machine that grows slower slows all alike.

use std::time::Duration;

use super::{Journal, Run, Study, Trial};
use crate::output::OutputError;

/// Told before each run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn<'a> {
    /// Runs that are done, and all that there are to be as far as is known.
    pub done: usize,
    pub all: usize,
    /// What is run now, in words.
    pub words: &'a str,
    /// About how long the rest takes; none before a first run.
    pub left: Option<Duration>,
}

/// How a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completion {
    Done,
    Interrupted,
}

impl Study {
    /// Makes the runs that the journal lacks. `stop` ends the session after the step that it is in.
    ///
    /// # Errors
    /// Errors of the file system. A run that fails is no error: its row says so.
    pub fn run(
        &self,
        journal: &mut Journal,
        told: &mut dyn FnMut(Turn<'_>),
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Completion, OutputError> {
        self.run_with(journal, told, stop, &|trial| trial.run(stop))
    }

    fn run_with(
        &self,
        journal: &mut Journal,
        told: &mut dyn FnMut(Turn<'_>),
        stop: &dyn Fn() -> bool,
        make: &dyn Fn(&Trial) -> Option<Run>,
    ) -> Result<Completion, OutputError> {
        while let Some(trial) = self.next(journal.runs()) {
            if stop() {
                return Ok(Completion::Interrupted);
            }
            let words = self.settings.iter().find(|setting| setting.trial == trial);
            told(self.turn(journal.runs(), words.map_or("", |setting| &setting.words)));
            match make(&self.trials[trial]) {
                Some(run) => journal.append(trial, run)?,
                None => return Ok(Completion::Interrupted),
            }
        }
        Ok(Completion::Done)
    }

    /// The trial with the fewest runs of those that need more; the first of several.
    fn next(&self, runs: &[Vec<Run>]) -> Option<usize> {
        let open = (0..runs.len()).filter(|&trial| runs[trial].len() < self.wanted(&runs[trial]));
        open.min_by_key(|&trial| runs[trial].len())
    }

    /// How many runs a trial needs that has these: the first warms up and is not counted, unless it failed or took so long
    /// that it is the only one.
    fn wanted(&self, runs: &[Run]) -> usize {
        match runs.first() {
            Some(first) if !first.end.is_good() || first.seconds.wall > self.repeat_below => 1,
            _ => 1 + self.repeats as usize,
        }
    }

    /// The runs that count.
    pub(super) fn counted<'a>(&self, runs: &'a [Run]) -> &'a [Run] {
        if runs.len() > 1 { &runs[1..] } else { runs }
    }

    fn turn<'a>(&self, runs: &[Vec<Run>], words: &'a str) -> Turn<'a> {
        let done = runs.iter().map(Vec::len).sum();
        let missing = |runs: &Vec<Run>| self.wanted(runs).saturating_sub(runs.len());
        let all = done + runs.iter().map(missing).sum::<usize>();
        // A trial that has not run yet takes what the others took in the mean, once.
        let known: Vec<f64> = runs.iter().filter_map(|runs| runs.last()).map(|run| run.seconds.wall).collect();
        let mean = known.iter().sum::<f64>() / known.len() as f64;
        let left: f64 =
            runs.iter().map(|runs| missing(runs) as f64 * runs.last().map_or(mean, |run| run.seconds.wall)).sum();
        let left = (!known.is_empty()).then(|| Duration::try_from_secs_f64(left).unwrap_or_default());
        Turn { done, all, words, left }
    }
}
