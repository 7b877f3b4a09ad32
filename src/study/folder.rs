//! The folder of a study: what each file in it is called, and what it is made of.

use std::fs;
use std::io::{BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::{Table, csv, markdown};
use crate::output::OutputError;
use crate::output::file::write_whole;
use crate::output::picture;

const FILES: [&str; 5] = ["runs.jsonl", "cost.json", "cost.csv", "cost.md", "cost.png"];

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudyFolder {
    path: PathBuf,
}

impl StudyFolder {
    /// Names a folder; makes nothing.
    pub fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// True where a study was begun in it.
    pub fn is_begun(&self) -> bool {
        self.journal().is_file()
    }

    /// True where a study was drawn in it.
    pub fn is_drawn(&self) -> bool {
        self.path.join("cost.json").is_file()
    }

    /// Makes the folder. With `fresh`, the files of an earlier study in it are removed; others stay.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(&self, fresh: bool) -> Result<(), OutputError> {
        fs::create_dir_all(&self.path).map_err(OutputError::io(&self.path))?;
        for file in FILES.iter().map(|name| self.path.join(name)).filter(|_| fresh) {
            match fs::remove_file(&file) {
                Err(error) if error.kind() != ErrorKind::NotFound => return Err(OutputError::io(&file)(error)),
                _ => {}
            }
        }
        Ok(())
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Every run, one a line.
    pub fn journal(&self) -> PathBuf {
        self.path.join("runs.jsonl")
    }

    /// Writes cost.json, cost.csv, cost.md and cost.png.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn write(&self, table: &Table) -> Result<(), OutputError> {
        let path = self.path.join("cost.json");
        write_whole(&path, |file| {
            serde_json::to_writer_pretty(&mut *file, table)
                .map_err(|source| OutputError::Json { path: path.clone(), source })?;
            file.write_all(b"\n").map_err(OutputError::io(&path))
        })?;
        csv::write(&self.path.join("cost.csv"), table)?;
        self.draw(table).map(|_| ())
    }

    /// Writes cost.md and cost.png, and returns their paths.
    fn draw(&self, table: &Table) -> Result<Vec<PathBuf>, OutputError> {
        let (words, drawn) = (self.path.join("cost.md"), self.path.join("cost.png"));
        markdown::write(&words, table)?;
        picture::draw_cost(&drawn, table)?;
        Ok(vec![words, drawn])
    }

    /// Writes cost.md and cost.png of a study that is over again, and returns their paths.
    ///
    /// # Errors
    /// A folder without a study's cost.json, errors of the file system.
    pub fn render(&self) -> Result<Vec<PathBuf>, OutputError> {
        let path = self.path.join("cost.json");
        let file = BufReader::new(fs::File::open(&path).map_err(OutputError::io(&path))?);
        let table = serde_json::from_reader(file).map_err(|source| OutputError::Json { path: path.clone(), source })?;
        self.draw(&table)
    }
}
