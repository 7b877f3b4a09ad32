//! Where a run is written.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::CliError;
use super::args::RunArguments;

/// The folder asked for, else `runs/` and the case file's name. Makes nothing.
///
/// # Errors
/// A path that is no folder; a folder with something in it, unless `--force` is given.
pub(super) fn output_folder(arguments: &RunArguments) -> Result<PathBuf, CliError> {
    let folder = match &arguments.out {
        Some(out) => out.clone(),
        None => {
            let case = &arguments.case.case;
            let stem = case.file_stem().ok_or_else(|| CliError::NoName { path: case.clone() })?;
            Path::new("runs").join(stem)
        }
    };
    match fs::read_dir(&folder) {
        Ok(entries) => match arguments.force || entries.count() == 0 {
            true => Ok(folder),
            false => Err(CliError::FolderTaken { path: folder }),
        },
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(folder),
        Err(error) if error.kind() == ErrorKind::NotADirectory => Err(CliError::NotFolder { path: folder }),
        Err(source) => Err(CliError::FolderUnreadable { path: folder, source }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::args::{CaseArguments, EngineChoice};
    use super::*;

    fn asked(case: &str, out: Option<&Path>, force: bool) -> RunArguments {
        let case = CaseArguments { case: case.into(), overrides: Vec::new() };
        let (engine, out) = (EngineChoice::Auto, out.map(Path::to_path_buf));
        RunArguments { case, out, force, engine, adapter: None, precision: None, checkpoint_every: None, quiet: true }
    }

    #[test]
    fn a_run_is_named_after_its_case() {
        let folder = output_folder(&asked("cases/none_such.toml", None, false)).expect("a folder");
        assert_eq!(folder, Path::new("runs/none_such"));
        assert!(matches!(output_folder(&asked("..", None, false)), Err(CliError::NoName { .. })));
    }

    #[test]
    fn only_force_writes_over_what_is_there() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let out = folder.path();
        assert_eq!(output_folder(&asked("c.toml", Some(out), false)).expect("an empty folder"), out);
        let file = out.join("summary.json");
        fs::write(&file, "{}").expect("a file");
        assert!(matches!(output_folder(&asked("c.toml", Some(out), false)), Err(CliError::FolderTaken { .. })));
        assert_eq!(output_folder(&asked("c.toml", Some(out), true)).expect("with --force"), out);
        assert!(matches!(output_folder(&asked("c.toml", Some(&file), true)), Err(CliError::NotFolder { .. })));
    }
}
