//! The folder of one run.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::OutputError;

/// Files that a run writes; overwriting a folder removes these alone.
const FILES: [&str; 10] = [
    "points.csv",
    "points.vtu",
    "diagnostics.csv",
    "summary.json",
    "pressure.png",
    "speed.png",
    "centreline.png",
    "temperature.png",
    "gradient.png",
    "laplacian.png",
];

/// What the names of pictures of tracers begin with.
const TRACER: &str = "tracer_";

/// Where a run's files lie.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunFolder {
    path: PathBuf,
}

impl RunFolder {
    /// Makes the folder, and those above it. With `force`, the files of an earlier run in it are removed; others stay.
    ///
    /// # Errors
    /// A folder with something in it, unless `force`; a path that is not a folder; errors of the file system.
    pub fn create(path: &Path, force: bool) -> Result<Self, OutputError> {
        if path.exists() && !path.is_dir() {
            return Err(OutputError::NotAFolder(path.to_owned()));
        }
        fs::create_dir_all(path).map_err(OutputError::io(path))?;
        let folder = Self { path: path.to_owned() };
        if force {
            let entries = fs::read_dir(path).map_err(OutputError::io(path))?;
            let tracers = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
            let tracers = tracers.filter(|name| name.starts_with(TRACER) && name.ends_with(".png"));
            for name in FILES.map(str::to_owned).into_iter().chain(tracers) {
                let file = path.join(name);
                match fs::remove_file(&file) {
                    Err(error) if error.kind() != ErrorKind::NotFound => return Err(OutputError::io(&file)(error)),
                    _ => {}
                }
            }
        } else if fs::read_dir(path).map_err(OutputError::io(path))?.next().is_some() {
            return Err(OutputError::NotEmpty(path.to_owned()));
        }
        Ok(folder)
    }

    /// The folder of a run that is over.
    ///
    /// # Errors
    /// A path that is not a folder.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        if !path.is_dir() {
            return Err(OutputError::NotAFolder(path.to_owned()));
        }
        Ok(Self { path: path.to_owned() })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn points(&self) -> PathBuf {
        self.path.join("points.csv")
    }

    pub fn vtu(&self) -> PathBuf {
        self.path.join("points.vtu")
    }

    pub fn diagnostics(&self) -> PathBuf {
        self.path.join("diagnostics.csv")
    }

    pub fn summary(&self) -> PathBuf {
        self.path.join("summary.json")
    }

    pub fn pressure_picture(&self) -> PathBuf {
        self.path.join("pressure.png")
    }

    pub fn speed_picture(&self) -> PathBuf {
        self.path.join("speed.png")
    }

    /// Of a field that the flow carries.
    pub fn carried_picture(&self, name: &str) -> PathBuf {
        match name {
            "temperature" => self.path.join("temperature.png"),
            _ => self.path.join(format!("{TRACER}{name}.png")),
        }
    }

    pub fn gradient_picture(&self) -> PathBuf {
        self.path.join("gradient.png")
    }

    pub fn laplacian_picture(&self) -> PathBuf {
        self.path.join("laplacian.png")
    }

    pub fn centreline_picture(&self) -> PathBuf {
        self.path.join("centreline.png")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_earlier_run_is_kept_unless_forced() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("runs/cavity");
        let folder = RunFolder::create(&path, false).unwrap();
        // Made and still empty: another run may have it.
        RunFolder::create(&path, false).unwrap();
        fs::write(folder.points(), "x").unwrap();
        fs::write(path.join("notes.txt"), "mine").unwrap();
        assert!(matches!(RunFolder::create(&path, false), Err(OutputError::NotEmpty(_))));
        RunFolder::create(&path, true).unwrap();
        assert!(!folder.points().exists() && path.join("notes.txt").exists());
    }

    #[test]
    fn every_file_of_a_run_is_among_those_that_force_removes() {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::open(root.path()).unwrap();
        for path in [
            folder.points(),
            folder.vtu(),
            folder.diagnostics(),
            folder.summary(),
            folder.pressure_picture(),
            folder.speed_picture(),
            folder.centreline_picture(),
            folder.gradient_picture(),
            folder.laplacian_picture(),
        ] {
            fs::write(path, "").unwrap();
        }
        RunFolder::create(root.path(), true).unwrap();
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_file_is_not_a_folder() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("file");
        fs::write(&path, "").unwrap();
        assert!(matches!(RunFolder::create(&path, true), Err(OutputError::NotAFolder(_))));
        assert!(matches!(RunFolder::open(&path), Err(OutputError::NotAFolder(_))));
    }
}
