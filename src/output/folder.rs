//! The folder of one run.

use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::OutputError;
use super::file::PART;

/// Files that a run writes; overwriting a folder removes these alone.
const FILES: [&str; 18] = [
    "checkpoint",
    "points.csv",
    "points.vtu",
    "diagnostics.csv",
    "motion.csv",
    "lost.csv",
    "summary.json",
    "pressure.png",
    "speed.png",
    "centreline.png",
    "temperature.png",
    "gradient.png",
    "laplacian.png",
    "sheet.png",
    "heights.png",
    "animation.png",
    "front.png",
    "sensors.png",
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
            folder.check_free()?;
            folder.remove_parts()?;
            let entries = fs::read_dir(path).map_err(OutputError::io(path))?;
            let tracers = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
            let tracers = tracers.filter(|name| name.starts_with(TRACER) && name.ends_with(".png"));
            for name in FILES.map(str::to_owned).into_iter().chain(tracers) {
                remove(&path.join(name))?;
            }
            remove_frames(&folder.frames())?;
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

    /// The folder of a run that is to go on. What a kill left half written is removed.
    ///
    /// # Errors
    /// A path that is not a folder, one that another process runs in, errors of the file system.
    pub fn resume(path: &Path) -> Result<Self, OutputError> {
        let folder = Self::open(path)?;
        folder.check_free()?;
        folder.remove_parts()?;
        Ok(folder)
    }

    /// A run that goes on holds its diagnostics.
    fn check_free(&self) -> Result<(), OutputError> {
        let held = File::open(self.diagnostics()).map(|file| file.try_lock());
        match held {
            Ok(Err(TryLockError::WouldBlock)) => Err(OutputError::Busy(self.path.clone())),
            _ => Ok(()),
        }
    }

    /// Removes files of a run that are not whole.
    fn remove_parts(&self) -> Result<(), OutputError> {
        let of_a_run = |name: &str| {
            FILES.iter().any(|known| name.strip_prefix(known).is_some_and(|rest| rest.starts_with('.')))
                || name.starts_with(TRACER)
        };
        remove_those(&self.path, |name| of_a_run(name) && name.ends_with(PART))?;
        if self.frames().is_dir() {
            remove_those(&self.frames(), |name| of_frames(name) && name.ends_with(PART))?;
        }
        Ok(())
    }

    /// Of a run that came to its end.
    ///
    /// # Errors
    /// Errors of the file system, but for a checkpoint that is not there.
    pub fn remove_checkpoint(&self) -> Result<(), OutputError> {
        remove(&self.checkpoint())
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn checkpoint(&self) -> PathBuf {
        self.path.join("checkpoint")
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

    /// Of points that move: a row a report.
    pub fn motion(&self) -> PathBuf {
        self.path.join("motion.csv")
    }

    /// Of points that move: those that left the domain.
    pub fn lost(&self) -> PathBuf {
        self.path.join("lost.csv")
    }

    /// Of points that move: the folder of the frames.
    pub fn frames(&self) -> PathBuf {
        self.path.join("frames")
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

    /// Of points that move: maps of the pressure at chosen times.
    pub fn sheet_picture(&self) -> PathBuf {
        self.path.join("sheet.png")
    }

    /// Of points that move: the pressure as a height over the plane at the same times.
    pub fn heights_picture(&self) -> PathBuf {
        self.path.join("heights.png")
    }

    /// Of points that move: all frames, one after the other.
    pub fn animation(&self) -> PathBuf {
        self.path.join("animation.png")
    }

    /// Of points that move: how far the fluid reaches against time.
    pub fn front_picture(&self) -> PathBuf {
        self.path.join("front.png")
    }

    /// Of points that move: the pressure at the sensors against time.
    pub fn sensors_picture(&self) -> PathBuf {
        self.path.join("sensors.png")
    }
}

/// Removes a file that may be absent.
pub(super) fn remove(file: &Path) -> Result<(), OutputError> {
    match fs::remove_file(file) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(OutputError::io(file)(error)),
        _ => Ok(()),
    }
}

/// Removes the files of a folder whose names are such. Returns whether others are left.
fn remove_those(folder: &Path, such: impl Fn(&str) -> bool) -> Result<bool, OutputError> {
    let mut others = false;
    for entry in fs::read_dir(folder).map_err(OutputError::io(folder))? {
        let path = entry.map_err(OutputError::io(folder))?.path();
        match path.file_name().is_some_and(|name| such(&name.to_string_lossy())) {
            true => remove(&path)?,
            false => others = true,
        }
    }
    Ok(others)
}

/// True of the name of a frame and of that of their times, whole or not.
fn of_frames(name: &str) -> bool {
    let (stem, end) = name.split_once('.').unwrap_or((name, ""));
    let numbered = stem.len() >= 4 && stem.chars().all(|c| c.is_ascii_digit());
    (numbered || stem == "times") && (end == "csv" || end.starts_with("csv.") && end.ends_with(PART))
}

/// Removes the frames of a run and their times, and the folder if nothing else is in it.
fn remove_frames(frames: &Path) -> Result<(), OutputError> {
    if frames.is_dir() && !remove_those(frames, of_frames)? {
        fs::remove_dir(frames).map_err(OutputError::io(frames))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::DiagnosticsWriter;
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
            folder.checkpoint(),
            folder.points(),
            folder.vtu(),
            folder.diagnostics(),
            folder.summary(),
            folder.pressure_picture(),
            folder.speed_picture(),
            folder.centreline_picture(),
            folder.carried_picture("temperature"),
            folder.carried_picture("ink"),
            folder.gradient_picture(),
            folder.laplacian_picture(),
            folder.motion(),
            folder.sheet_picture(),
            folder.heights_picture(),
            folder.animation(),
            folder.front_picture(),
            folder.sensors_picture(),
        ] {
            fs::write(path, "").unwrap();
        }
        fs::create_dir(folder.frames()).unwrap();
        for name in ["0000.csv", "12345.csv", "times.csv"] {
            fs::write(folder.frames().join(name), "").unwrap();
        }
        RunFolder::create(root.path(), true).unwrap();
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
    }

    #[test]
    fn what_else_lies_among_the_frames_stays() {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::open(root.path()).unwrap();
        fs::create_dir(folder.frames()).unwrap();
        for name in ["0003.csv", "0003.txt", "mine.csv"] {
            fs::write(folder.frames().join(name), "").unwrap();
        }
        RunFolder::create(root.path(), true).unwrap();
        let left = fs::read_dir(folder.frames()).unwrap().map(|entry| entry.unwrap().file_name());
        let mut left: Vec<_> = left.collect();
        left.sort();
        assert_eq!(left, ["0003.txt", "mine.csv"]);
    }

    #[test]
    fn what_a_kill_left_half_written_is_removed_and_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let path = |name: &str| root.path().join(name);
        fs::create_dir(path("frames")).unwrap();
        let parts = ["checkpoint.17.part", "summary.json.9.part", "frames/0003.csv.9.part", "frames/times.csv.9.part"];
        let others = ["notes.part", "checkpoint", "frames/0003.csv", "frames/mine.part"];
        for name in parts.iter().chain(&others) {
            fs::write(path(name), "").unwrap();
        }
        RunFolder::resume(root.path()).unwrap();
        assert!(parts.iter().all(|name| !path(name).exists()));
        assert!(others.iter().all(|name| path(name).exists()));
    }

    #[test]
    fn a_folder_that_a_run_is_in_is_left_alone() {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::create(root.path(), false).unwrap();
        let writer = DiagnosticsWriter::create(&folder.diagnostics(), vec![]).unwrap();
        assert!(matches!(RunFolder::resume(root.path()), Err(OutputError::Busy(_))));
        assert!(matches!(RunFolder::create(root.path(), true), Err(OutputError::Busy(_))));
        assert!(folder.diagnostics().exists());
        drop(writer);
        RunFolder::resume(root.path()).unwrap();
        let writer = DiagnosticsWriter::resume(&folder.diagnostics(), 0, vec![]).unwrap();
        assert!(matches!(RunFolder::resume(root.path()), Err(OutputError::Busy(_))));
        drop(writer);
        RunFolder::create(root.path(), true).unwrap();
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
