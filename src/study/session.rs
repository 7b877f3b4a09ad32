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

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::path::Path;

    use super::super::tests::{good_run, study};
    use super::super::{End, Machine};
    use super::*;

    /// Runs a study whose trials take `seconds` each, or fail where they take none, and returns the order of the runs.
    fn order(study: &Study, path: &Path, seconds: &[f64], stop_after: usize) -> (Vec<usize>, Completion) {
        let mut journal = Journal::open(path, &study.trials, &Machine::here()).expect("a journal");
        let made = RefCell::new(Vec::new());
        let make = |trial: &Trial| {
            let trial = study.trials.iter().position(|known| known == trial).expect("one of the study's");
            made.borrow_mut().push(trial);
            let failed = End::Failed { reason: "no time".to_owned() };
            let end = if seconds[trial] > 0.0 { End::Steady } else { failed };
            Some(Run { end, ..good_run(seconds[trial]) })
        };
        let stop = || made.borrow().len() >= stop_after;
        let completion = study.run_with(&mut journal, &mut |_| {}, &stop, &make).expect("a session");
        (made.into_inner(), completion)
    }

    #[test]
    fn trials_take_turns_and_slow_and_failing_ones_run_once() {
        let study = Study { repeats: 2, repeat_below: 5.0, ..study(4) };
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (made, completion) = order(&study, &folder.path().join("runs.jsonl"), &[0.1, 9.0, 0.0, 0.2], 100);
        assert_eq!((made, completion), (vec![0, 1, 2, 3, 0, 3, 0, 3], Completion::Done));
    }

    #[test]
    fn what_was_stopped_goes_on_and_what_is_done_is_not_done_again() {
        let study = Study { repeats: 1, ..study(3) };
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("runs.jsonl");
        assert_eq!(order(&study, &path, &[1.0; 3], 4), (vec![0, 1, 2, 0], Completion::Interrupted));
        assert_eq!(order(&study, &path, &[1.0; 3], 4), (vec![1, 2], Completion::Done));
        assert_eq!(order(&study, &path, &[1.0; 3], 4), (vec![], Completion::Done));
        let more = Study { repeats: 2, ..study };
        assert_eq!(order(&more, &path, &[1.0; 3], 4), (vec![0, 1, 2], Completion::Done), "one more of each");
    }

    #[test]
    fn the_first_run_warms_up_and_counts_only_where_it_is_alone() {
        let study = study(1);
        let runs = [3.0, 1.0, 2.0].map(good_run);
        assert_eq!(study.counted(&runs), &runs[1..]);
        assert_eq!(study.counted(&runs[..1]), &runs[..1]);
    }

    #[test]
    fn a_turn_says_how_many_runs_there_are_and_about_how_long_they_take() {
        let study = Study { repeats: 1, repeat_below: 5.0, ..study(3) };
        let runs = [vec![good_run(2.0), good_run(2.0)], vec![good_run(4.0)], vec![]];
        let Turn { done, all, left, .. } = study.turn(&runs, "");
        // One more of the second, and two of the third at the mean of the others.
        assert_eq!((done, all, left), (3, 6, Some(Duration::from_secs(4 + 2 * 3))));
        assert_eq!(study.turn(&[vec![], vec![], vec![]], "").left, None);
    }
}
