//! `cost`: runs the settings of a study and shows their errors against the time they take.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::args::CostArguments;
use super::interrupt::StopFlag;
use super::turns::Turns;
use super::{CliError, print};
use crate::study::{Completion, Journal, Machine, Study, StudyFolder, Table, plain};

pub(super) fn cost(arguments: &CostArguments) -> Result<(), CliError> {
    let study = Study::load(&arguments.study, &arguments.overrides)?;
    let folder = StudyFolder::at(&free_folder(arguments)?);
    let stop = StopFlag::on_interrupt()?;
    folder.create(arguments.fresh)?;
    let machine = Machine::here();
    let mut journal = Journal::open(&folder.journal(), &study.trials, &machine)?;
    let turns = Turns::new(arguments.quiet);
    let started = Instant::now();
    let completion = study.run(&mut journal, &mut |turn| turns.show(turn), &|| stop.is_raised())?;
    turns.finish();
    let table = Table::new(&study, journal.runs(), &machine, command(arguments));
    folder.write(&table)?;
    tell(&table, completion, started.elapsed().as_secs_f64(), &folder)
}

/// The folder asked for, else `runs/` and the study file's name. Makes nothing.
///
/// # Errors
/// A path that is no folder; a folder with something in it and no study.
fn free_folder(arguments: &CostArguments) -> Result<PathBuf, CliError> {
    let path = match &arguments.out {
        Some(out) => out.clone(),
        None => {
            let stem = arguments.study.file_stem();
            Path::new("runs").join(stem.ok_or_else(|| CliError::NoName { path: arguments.study.clone() })?)
        }
    };
    match fs::read_dir(&path) {
        Ok(entries) => match StudyFolder::at(&path).is_begun() || entries.count() == 0 {
            true => Ok(path),
            false => Err(CliError::NoStudy { path }),
        },
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(path),
        Err(error) if error.kind() == ErrorKind::NotADirectory => Err(CliError::NotFolder { path }),
        Err(source) => Err(CliError::FolderUnreadable { path, source }),
    }
}

/// The command line that makes the study again, wherever it is written.
fn command(arguments: &CostArguments) -> String {
    let set: String =
        arguments.overrides.iter().map(|given| format!(" --set '{}'", given.replace('\'', "'\\''"))).collect();
    format!("cargo run --release -- cost {}{set}", arguments.study.display())
}

fn tell(table: &Table, completion: Completion, seconds: f64, folder: &StudyFolder) -> Result<(), CliError> {
    let failed = table.rows.iter().filter(|row| row.runs > 0 && row.error.is_none()).count();
    let missing = table.rows.iter().filter(|row| row.runs == 0).count();
    print(&table.title)?;
    let mut words = format!("{} settings in {seconds:.0} s", table.rows.len());
    if failed > 0 {
        words += &format!(", {failed} without an error");
    }
    if completion == Completion::Interrupted {
        words += &format!(", interrupted with {missing} not yet run; the same command goes on");
    }
    print(words)?;
    for &target in &table.targets {
        let percent = 100.0 * target;
        match table.cheapest(target).map(|row| &table.rows[row]) {
            Some(row) => {
                let seconds = table.place(row).map_or(0.0, |(_, seconds)| seconds.median);
                print(format_args!("  {percent}%: {} s, {}", plain(seconds), table.in_words(row)))?;
            }
            None => print(format_args!("  {percent}%: none reaches it"))?,
        }
    }
    print(format_args!("written to {}", folder.path().display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(study: &str, out: Option<&Path>) -> CostArguments {
        let out = out.map(Path::to_path_buf);
        CostArguments { study: study.into(), overrides: vec!["repeats=1".into()], out, fresh: false, quiet: true }
    }

    #[test]
    fn a_study_is_named_after_its_file_and_taken_up_again_where_it_was_begun() {
        assert_eq!(free_folder(&asked("a/none_such.toml", None)).expect("a folder"), Path::new("runs/none_such"));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let asked = asked("a.toml", Some(folder.path()));
        free_folder(&asked).expect("an empty folder");
        fs::write(folder.path().join("notes.txt"), "mine").expect("a file");
        assert!(matches!(free_folder(&asked), Err(CliError::NoStudy { .. })));
        fs::write(folder.path().join("runs.jsonl"), "").expect("a file");
        free_folder(&asked).expect("a study's folder");
    }

    #[test]
    fn the_command_has_what_was_set() {
        let arguments = CostArguments { overrides: vec!["set.time.end=1".into()], ..asked("s/a.toml", None) };
        assert_eq!(command(&arguments), "cargo run --release -- cost s/a.toml --set 'set.time.end=1'");
    }
}
