//! Reads a small text file whole, and says plainly what is wrong with one that cannot be read.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::error::one_line;

/// Largest text file that is read, bytes: enough for any case or profile, too small for a mistaken path to hurt.
const LARGEST: u64 = 1 << 20;

/// Why a text file could not be read.
#[derive(Debug, Error)]
pub enum TextError {
    #[error("{}: no such file", plain(path))]
    Missing { path: PathBuf },
    #[error("{}: a folder, where a file was expected", plain(path))]
    Folder { path: PathBuf },
    #[error("{}: cannot be read: {source}", plain(path))]
    Unreadable { path: PathBuf, source: io::Error },
    #[error("{}: larger than {LARGEST} bytes, which is no case file or profile", plain(path))]
    TooLarge { path: PathBuf },
    #[error("{}:{line}: not UTF-8 text", plain(path))]
    NotUtf8 { path: PathBuf, line: usize },
}

/// A path that a file gives may hold anything; an error is one line.
fn plain(path: &Path) -> String {
    one_line(&path.display().to_string())
}

/// The whole of a UTF-8 text file, without the byte order mark that some editors put first.
pub(crate) fn read(path: &Path) -> Result<String, TextError> {
    let bytes = read_bytes(path).map_err(|source| match source.kind() {
        ErrorKind::NotFound => TextError::Missing { path: path.into() },
        ErrorKind::IsADirectory => TextError::Folder { path: path.into() },
        _ => TextError::Unreadable { path: path.into(), source },
    })?;
    if bytes.len() as u64 > LARGEST {
        return Err(TextError::TooLarge { path: path.into() });
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|byte| **byte == b'\n').count();
        TextError::NotUtf8 { path: path.into(), line }
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    // Not every system refuses to open a folder.
    if path.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
