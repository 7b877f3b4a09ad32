//! What points that move leave behind: motion.csv, one row a report, lost.csv, and frames/, the whole state at regular times.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::file::{finite, sync, write_whole};
use super::folder::remove;
use super::lost::LostWriter;
use super::{OutputError, RunFolder, points, rows};
use crate::case::Case;
use crate::motion::Row;
use crate::snapshot::Snapshot;

const HEADER: &str = "step,time,kinetic_energy,potential_energy,nearest_least,nearest_mean,nearest_most,front,column,area,surface,lowered,lost,bounded";

/// Appends rows to motion.csv, lost points to lost.csv, and numbers the frames.
#[derive(Debug)]
pub struct MotionWriter {
    path: PathBuf,
    file: File,
    lost: LostWriter,
    frames: PathBuf,
    /// Times of the frames, s.
    kept: Vec<f64>,
    /// Frames of which the disk itself has every byte.
    synced: usize,
}

impl MotionWriter {
    /// Starts the file with its header; the columns of sensors are called `p_NAME`.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(folder: &RunFolder, case: &Case) -> Result<Self, OutputError> {
        let (path, frames) = (folder.motion(), folder.frames());
        let mut file = File::create(&path).map_err(OutputError::io(&path))?;
        writeln!(file, "{}", header(case)).map_err(OutputError::io(&path))?;
        if case.output.frame_every.is_some() {
            fs::create_dir_all(&frames).map_err(OutputError::io(&frames))?;
        }
        Ok(Self { path, file, lost: LostWriter::new(folder.lost()), frames, kept: Vec::new(), synced: 0 })
    }

    /// Goes on with the files of a run from its state after `step`, when it had kept so many frames: what is behind them is
    /// dropped, to be made again. The rows up to there come with it.
    ///
    /// # Errors
    /// A file that is not of this kind, or lacks the row of that step, or frames; errors of the file system.
    pub fn resume(folder: &RunFolder, case: &Case, step: u64, count: u32) -> Result<(Self, Vec<Row>), OutputError> {
        let (path, frames) = (folder.motion(), folder.frames());
        rows::cut(&path, &header(case), "motion", step)?;
        let mut rows = read(&path)?;
        let lost = LostWriter::resume(folder.lost(), &mut rows)?;
        let mut kept = Frames::open(&frames)?.times;
        let (found, count) = (kept.len(), count as usize);
        kept.truncate(count);
        if let Some(number) = (0..count).find(|&number| number >= found || !frame(&frames, number).is_file()) {
            let what = format!("frame {number}, which the checkpoint counts on, is not there");
            return Err(OutputError::Csv { path: times(&frames), line: number + 2, what });
        }
        // One more than it has the times of: a kill came between the two.
        for number in count..=found {
            remove(&frame(&frames, number))?;
        }
        let file = OpenOptions::new().append(true).open(&path).map_err(OutputError::io(&path))?;
        let writer = Self { path, file, lost, frames, kept, synced: count };
        if case.output.frame_every.is_some() {
            writer.write_times()?;
        }
        Ok((writer, rows))
    }

    /// Has rows and frames on the disk itself: they are to be there before a checkpoint that counts on them.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn sync(&mut self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(OutputError::io(&self.path))?;
        self.lost.sync()?;
        if self.synced < self.kept.len() {
            (self.synced..self.kept.len()).try_for_each(|number| sync(&frame(&self.frames, number)))?;
            sync(&times(&self.frames))?;
            if cfg!(unix) {
                sync(&self.frames)?;
            }
            self.synced = self.kept.len();
        }
        Ok(())
    }

    /// Appends one row and flushes it.
    ///
    /// # Errors
    /// A value that is not finite (the row is not written then), errors of the file system.
    pub fn append(&mut self, row: &Row) -> Result<(), OutputError> {
        let [least, mean, most] = row.nearest;
        let reals = [row.kinetic_energy, row.potential_energy, least, mean, most, row.front, row.column, row.area];
        for &value in reals.iter().chain(&row.sensors) {
            finite(&format!("motion of step {}", row.step), value)?;
        }
        let Row { step, time, surface, lowered, lost, bounded, .. } = row;
        let reals: String = reals.iter().map(|value| format!(",{value:?}")).collect();
        let sensors: String = row.sensors.iter().map(|value| format!(",{value:?}")).collect();
        let line = format!("{step},{time:?}{reals},{surface},{lowered},{lost},{bounded}{sensors}\n");
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush());
        written.map_err(OutputError::io(&self.path))?;
        self.lost.append(row)
    }

    /// Writes a frame, `frames/0000.csv` the first, and its time into `frames/times.csv`.
    ///
    /// # Errors
    /// A value that is not finite, errors of the file system.
    pub fn keep(&mut self, snapshot: &Snapshot) -> Result<(), OutputError> {
        points::write(&frame(&self.frames, self.kept.len()), snapshot)?;
        self.kept.push(snapshot.time);
        self.write_times()
    }

    fn write_times(&self) -> Result<(), OutputError> {
        let path = times(&self.frames);
        let rows: String = self.kept.iter().enumerate().map(|(k, time)| format!("{k},{time:?}\n")).collect();
        write_whole(&path, |file| write!(file, "frame,time\n{rows}").map_err(OutputError::io(&path)))
    }
}

/// The first line of motion.csv.
fn header(case: &Case) -> String {
    let sensors: String = case.output.sensors.keys().map(|name| format!(",p_{name}")).collect();
    format!("{HEADER}{sensors}")
}

/// The rows of motion.csv, its columns behind the fixed ones those of the sensors.
///
/// # Errors
/// A file that is no such table, errors of the file system.
pub fn read(path: &Path) -> Result<Vec<Row>, OutputError> {
    let fixed = HEADER.split(',').count();
    let wrong = |line: usize, what: &str| OutputError::Csv { path: path.to_owned(), line, what: what.to_owned() };
    let text = fs::read_to_string(path).map_err(OutputError::io(path))?;
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, header)| header);
    if !header.starts_with(HEADER) {
        return Err(wrong(1, &format!("the header is `{header}`")));
    }
    let columns = header.split(',').count();
    lines
        .map(|(line, text)| {
            let cells = text.split(',').map(|cell| cell.parse::<f64>().ok().filter(|value| value.is_finite()));
            let cells = cells.collect::<Option<Vec<f64>>>().ok_or_else(|| wrong(line + 1, "a cell is not a number"))?;
            if cells.len() != columns {
                return Err(wrong(line + 1, &format!("{} cells, and the header names {columns}", cells.len())));
            }
            Ok(Row {
                step: cells[0] as u64,
                time: cells[1],
                kinetic_energy: cells[2],
                potential_energy: cells[3],
                nearest: [cells[4], cells[5], cells[6]],
                front: cells[7],
                column: cells[8],
                area: cells[9],
                surface: cells[10] as u64,
                lowered: cells[11] as u64,
                lost: cells[12] as u64,
                bounded: cells[13] as u64,
                outside: Vec::new(),
                sensors: cells[fixed..].to_vec(),
            })
        })
        .collect()
}

/// The frames that a run has left, each read when it is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    folder: PathBuf,
    /// s
    times: Vec<f64>,
}

impl Frames {
    /// Of the folder `frames/` of a run; none where there is no such folder.
    ///
    /// # Errors
    /// A file of times that is no such table, errors of the file system.
    pub fn open(folder: &Path) -> Result<Self, OutputError> {
        let path = times(folder);
        if !path.is_file() {
            return Ok(Self { folder: folder.to_owned(), times: Vec::new() });
        }
        let text = fs::read_to_string(&path).map_err(OutputError::io(&path))?;
        let time = |(line, row): (usize, &str)| {
            let time = row.split_once(',').and_then(|(_, time)| time.parse::<f64>().ok());
            let what = "not a number of a frame and its time".to_owned();
            time.ok_or_else(|| OutputError::Csv { path: path.clone(), line: line + 1, what })
        };
        let times = text.lines().enumerate().skip(1).map(time).collect::<Result<Vec<f64>, OutputError>>()?;
        Ok(Self { folder: folder.to_owned(), times })
    }

    pub fn count(&self) -> usize {
        self.times.len()
    }

    /// s
    pub fn time(&self, number: usize) -> f64 {
        self.times[number]
    }

    /// The frame nearest to a time, s, unless the time is farther from it than half way to another: none after the end.
    pub fn near(&self, time: f64) -> Option<usize> {
        let off = |number: &usize| (self.times[*number] - time).abs();
        let nearest = (0..self.count()).min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let apart = self.times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        (off(&nearest) <= 0.5 * apart + 1e-12).then_some(nearest)
    }

    /// # Errors
    /// A frame that cannot be read.
    pub fn read(&self, number: usize) -> Result<Snapshot, OutputError> {
        points::read(&frame(&self.folder, number), self.times[number])
    }
}

/// The file of a frame.
fn frame(frames: &Path, number: usize) -> PathBuf {
    frames.join(format!("{number:04}.csv"))
}

/// The file of their times.
fn times(frames: &Path) -> PathBuf {
    frames.join("times.csv")
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn case() -> Case {
        toml::from_str(
            "title = 't'\ndomain = { width = 1.0, height = 1.0 }\ncloud = { arrangement = 'regular', spacing = 0.1 }\n\
             fluid.density = 1.0\noutput = { frame_every = 0.5, sensors = { a = { at = [0.0, 0.0] } } }\n",
        )
        .unwrap()
    }

    #[test]
    fn rows_and_frames_read_back_as_they_were_written() {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::create(root.path(), false).unwrap();
        let mut writer = MotionWriter::create(&folder, &case()).unwrap();
        let row = |step: u64| {
            let reals = [0.1 + 0.2, 1.0 / 3.0];
            let nearest = [0.5, reals[1], 1.5];
            Row {
                step,
                time: reals[0],
                front: 2.0,
                nearest,
                surface: 7,
                lost: 1,
                bounded: 2,
                sensors: vec![-3.5],
                ..Row::default()
            }
        };
        writer.append(&row(1)).unwrap();
        writer.append(&row(2)).unwrap();
        assert!(writer.append(&Row { front: f64::NAN, ..row(3) }).is_err());
        assert_eq!(read(&folder.motion()).unwrap(), [row(1), row(2)]);

        let state = |time: f64| {
            let one = vec![DVec2::new(time, 0.5)];
            Snapshot { time, position: one.clone(), velocity: one, pressure: vec![time], ..Snapshot::default() }
        };
        for time in [0.0, 0.5, 1.0] {
            writer.keep(&state(time)).unwrap();
        }
        let frames = Frames::open(&folder.frames()).unwrap();
        assert_eq!((frames.count(), frames.read(1).unwrap()), (3, state(0.5)));
        // Gone on with from step 1, when there were two.
        let (mut resumed, rows) = MotionWriter::resume(&folder, &case(), 1, 2).unwrap();
        assert_eq!(rows, [row(1)]);
        assert!(!folder.frames().join("0002.csv").exists());
        resumed.append(&row(2)).unwrap();
        resumed.keep(&state(1.0)).unwrap();
        resumed.sync().unwrap();
        assert_eq!(read(&folder.motion()).unwrap(), [row(1), row(2)]);
        assert_eq!(Frames::open(&folder.frames()).unwrap(), frames);
        let lacks = MotionWriter::resume(&folder, &case(), 2, 4).unwrap_err().to_string();
        assert!(lacks.ends_with("times.csv, line 5: frame 3, which the checkpoint counts on, is not there"), "{lacks}");
        let lacks = MotionWriter::resume(&folder, &case(), 3, 1).unwrap_err().to_string();
        assert!(lacks.contains("the row of step 3, which the checkpoint is of, is not there"), "{lacks}");
        assert_eq!([0.0, 0.7, 1.2, 1.4].map(|time| frames.near(time)), [Some(0), Some(1), Some(2), None]);
        assert_eq!(Frames::open(root.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_broken_table_is_named_with_its_line() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("motion.csv");
        for (text, what) in [
            ("x\n".to_owned(), "line 1: the header is `x`"),
            (format!("{HEADER}\n1,2\n"), "line 2: 2 cells, and the header names 14"),
            (format!("{HEADER}\n1,x\n"), "line 2: a cell is not a number"),
        ] {
            fs::write(&path, text).unwrap();
            let error = read(&path).unwrap_err().to_string();
            assert!(error.ends_with(what), "{error}");
        }
    }
}
