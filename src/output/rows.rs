//! Tables with a row a report, as a run that goes on takes them up again.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;

use super::OutputError;
use super::file::write_whole;

/// Drops the rows of a table behind that of `step`, and one that a kill cut off; every row begins with its step. `of` is what a
/// run's table is of.
///
/// # Errors
/// A file that is not of this kind, or lacks the row of that step; errors of the file system.
pub(super) fn cut(path: &Path, header: &str, of: &str, step: u64) -> Result<(), OutputError> {
    let wrong = |line: usize, what: &str| OutputError::Csv { path: path.to_owned(), line, what: what.to_owned() };
    let mut file = BufReader::new(File::open(path).map_err(OutputError::io(path))?);
    let (mut kept, mut lines, mut last) = (Vec::new(), 0, 0);
    loop {
        let begin = kept.len();
        file.read_until(b'\n', &mut kept).map_err(OutputError::io(path))?;
        let line = kept[begin..].strip_suffix(b"\n");
        let step_of = |line: &[u8]| std::str::from_utf8(line.split(|&byte| byte == b',').next()?).ok()?.parse().ok();
        match line {
            Some(line) if lines == 0 && line == header.as_bytes() => {}
            Some(line) if lines > 0 => match step_of(line) {
                Some(row) if row <= step => last = row,
                Some(_) => kept.truncate(begin),
                None => return Err(wrong(lines + 1, "does not begin with the number of a step")),
            },
            _ if lines == 0 => return Err(wrong(1, &format!("not the header of a run's {of}"))),
            _ => kept.truncate(begin),
        }
        if kept.len() == begin {
            break;
        }
        lines += 1;
    }
    if last != step {
        return Err(wrong(lines, &format!("the row of step {step}, which the checkpoint is of, is not there")));
    }
    write_whole(path, |file| file.write_all(&kept).map_err(OutputError::io(path)))
}
