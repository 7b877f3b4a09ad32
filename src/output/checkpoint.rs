//! `checkpoint`: a state that a run can go on from, in one file.
//!
//! ```text
//! 8 bytes     what kind of file this is
//! 4 bytes     version of the format
//! 4 bytes     length of the head
//! the head    JSON: the case as TOML, who computes, where the run stands, the arrays by name, kind and length
//! the arrays  one after another: floats in the precision of the engine, indexes in 4 bytes
//! 4 bytes     CRC-32 of all before
//! ```
//!
//! Numbers are little-endian. Sizes are held against that of the file before its arrays are read into memory.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::OutputError;
use super::file::write_durable;
use crate::case::Case;
use crate::engine::{Data, EngineInfo};
use crate::scene::Scene;
use crate::simulation::{Progress, State};
use crate::step::Element;

/// No text file begins so, and a file that was taken for text and changed on its way does no longer.
const KIND: [u8; 8] = *b"\x89STILL\r\n";
const VERSION: u32 = 1;
/// Bytes before the head.
const FRONT: usize = 16;
/// Bytes after the arrays.
const BACK: usize = 4;
/// Longest head, bytes.
const LONGEST_HEAD: usize = 1 << 20;

/// Why a file is no checkpoint that this program can use.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointTrouble {
    #[error("no such file: the run kept no state to go on from; run its case again")]
    Missing,
    #[error("not a checkpoint of Stillpoint")]
    Foreign,
    #[error("a checkpoint of version {found}, from a newer Stillpoint; this one reads version {VERSION}")]
    Newer { found: u32 },
    #[error("a checkpoint that was cut short or added to: {found} bytes where {expected} are expected")]
    Length { found: u64, expected: u64 },
    #[error("a checkpoint that was altered since it was written: its checksum is another")]
    Altered,
    #[error("a checkpoint that cannot be used: {0}")]
    Useless(String),
}

/// All that a run is gone on with.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    pub head: Head,
    pub case: Case,
    /// The arrays, in the order of the head.
    data: Vec<Data>,
}

/// What the file says of itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    /// Version of the program that wrote it.
    pub program: String,
    /// The case file as it was named on the command line.
    pub case_path: PathBuf,
    /// The whole case, as TOML.
    case: String,
    /// `cpu` or `gpu`.
    pub engine: String,
    /// The GPU's name.
    pub adapter: Option<String>,
    /// `f32` or `f64`.
    pub precision: String,
    /// Steps between two checkpoints; none is kept on the way where absent.
    pub every: Option<u64>,
    pub progress: Progress,
    arrays: Vec<Shape>,
}

/// One array.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Shape {
    name: String,
    element: Kind,
    length: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    F32,
    F64,
    U32,
}

impl Kind {
    fn of(data: &Data, precision: &str) -> Self {
        match data {
            Data::Index(_) => Kind::U32,
            Data::Real(_) if precision == "f32" => Kind::F32,
            Data::Real(_) => Kind::F64,
        }
    }

    fn bytes(self) -> u64 {
        match self {
            Kind::F32 | Kind::U32 => 4,
            Kind::F64 => 8,
        }
    }

    fn decode(self, bytes: &[u8]) -> Data {
        match self {
            Kind::F32 => {
                Data::Real(bytes.as_chunks().0.iter().map(|&entry| f32::from_le_bytes(entry).into()).collect())
            }
            Kind::F64 => Data::Real(bytes.as_chunks().0.iter().map(|&entry| f64::from_le_bytes(entry)).collect()),
            Kind::U32 => Data::Index(bytes.as_chunks().0.iter().map(|&entry| u32::from_le_bytes(entry)).collect()),
        }
    }
}

impl Head {
    /// The head of a file of `found` bytes, of which the first are given, and where it ends.
    fn of(bytes: &[u8], found: u64) -> Result<(Self, usize), CheckpointTrouble> {
        let end = FRONT + head_length(bytes)?;
        let short = |expected: u64| CheckpointTrouble::Length { found, expected };
        let text = bytes.get(FRONT..end).ok_or(short((end + BACK) as u64))?;
        let head: Self = serde_json::from_slice(text).map_err(|_| CheckpointTrouble::Altered)?;
        let arrays = head.arrays.iter().try_fold((end + BACK) as u64, |sum, shape| {
            sum.checked_add(shape.length.checked_mul(shape.element.bytes())?)
        });
        match arrays {
            Some(expected) if expected == found => Ok((head, end)),
            expected => Err(short(expected.unwrap_or(u64::MAX))),
        }
    }
}

/// Writes a checkpoint of a run in the place of the last.
///
/// # Errors
/// Errors of the file system.
pub fn write(
    path: &Path,
    case_path: &Path,
    case: &Case,
    info: &EngineInfo,
    every: Option<u64>,
    state: &State,
) -> Result<(), OutputError> {
    let useless = |reason: String| refuse(path, CheckpointTrouble::Useless(reason));
    let shape = |(buffer, data): &(crate::step::Buffer, Data)| Shape {
        name: buffer.name(),
        element: Kind::of(data, info.precision),
        length: match data {
            Data::Real(values) => values.len() as u64,
            Data::Index(values) => values.len() as u64,
        },
    };
    let head = Head {
        program: env!("CARGO_PKG_VERSION").to_owned(),
        case_path: case_path.to_owned(),
        case: toml::to_string(case).map_err(|error| useless(error.to_string()))?,
        engine: info.engine.to_owned(),
        adapter: info.adapter.as_ref().map(|adapter| adapter.name.clone()),
        precision: info.precision.to_owned(),
        every,
        progress: state.progress.clone(),
        arrays: state.arrays.iter().map(shape).collect(),
    };
    let head = serde_json::to_vec(&head).map_err(|source| OutputError::Json { path: path.to_owned(), source })?;
    write_durable(path, |file| {
        let mut sum = crc32fast::Hasher::new();
        let mut put = |bytes: &[u8]| {
            sum.update(bytes);
            file.write_all(bytes).map_err(OutputError::io(path))
        };
        put(&KIND)?;
        put(&VERSION.to_le_bytes())?;
        put(&(head.len() as u32).to_le_bytes())?;
        put(&head)?;
        let mut bytes = Vec::new();
        for (_, data) in &state.arrays {
            bytes.clear();
            match (data, Kind::of(data, info.precision)) {
                (Data::Real(values), Kind::F32) => {
                    values.iter().for_each(|&value| bytes.extend((value as f32).to_le_bytes()));
                }
                (Data::Real(values), _) => values.iter().for_each(|value| bytes.extend(value.to_le_bytes())),
                (Data::Index(values), _) => values.iter().for_each(|value| bytes.extend(value.to_le_bytes())),
            }
            put(&bytes)?;
        }
        let sum = sum.finalize();
        file.write_all(&sum.to_le_bytes()).map_err(OutputError::io(path))
    })
}

impl Checkpoint {
    /// Reads and checks a checkpoint.
    ///
    /// # Errors
    /// A file that is none, was cut short, altered, or written by a newer program; errors of the file system.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let mut file = File::open(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => refuse(path, CheckpointTrouble::Missing),
            _ => OutputError::io(path)(error),
        })?;
        let found = file.metadata().map_err(OutputError::io(path))?.len();
        // What is not one of ours, or not as long as it says, is not read to its end.
        let mut bytes = Vec::new();
        let mut take = |bytes: &mut Vec<u8>, length: u64| {
            Read::by_ref(&mut file).take(length).read_to_end(bytes).map_err(OutputError::io(path))
        };
        take(&mut bytes, FRONT as u64)?;
        let length = head_length(&bytes).map_err(|trouble| refuse(path, trouble))?;
        take(&mut bytes, length as u64)?;
        Head::of(&bytes, found).map_err(|trouble| refuse(path, trouble))?;
        take(&mut bytes, found)?;
        Self::decode(&bytes, path)
    }

    /// As [`Checkpoint::read`], of bytes that are not read from `path`: errors name it.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub fn decode(bytes: &[u8], path: &Path) -> Result<Self, OutputError> {
        let refuse = |trouble| refuse(path, trouble);
        let useless = |reason: String| refuse(CheckpointTrouble::Useless(reason));
        let (head, end) = Head::of(bytes, bytes.len() as u64).map_err(refuse)?;
        let (body, sum) = bytes.split_at(bytes.len() - BACK);
        if crc32fast::hash(body).to_le_bytes() != sum {
            return Err(refuse(CheckpointTrouble::Altered));
        }
        head.progress.check().map_err(|reason| useless(reason.to_owned()))?;
        let case =
            Case::from_text(&head.case, Path::new("its case"), &[]).map_err(|error| useless(error.to_string()))?;
        let mut rest = &body[end..];
        let data = head.arrays.iter().map(|shape| {
            let (own, behind) = rest.split_at((shape.length * shape.element.bytes()) as usize);
            rest = behind;
            shape.element.decode(own)
        });
        let data = data.collect();
        Ok(Self { head, case, data })
    }

    /// The state, for a scene made of the case.
    ///
    /// # Errors
    /// Arrays that are not those of the scene; numbers that are not finite.
    pub fn state(self, scene: &Scene, path: &Path) -> Result<State, OutputError> {
        let useless = |reason: String| refuse(path, CheckpointTrouble::Useless(reason));
        let buffers = scene.plan.state();
        let Self { head, data, .. } = self;
        let fits = |(buffer, (shape, data)): (&crate::step::Buffer, (&Shape, &Data))| {
            let index = matches!(data, Data::Index(_));
            shape.name == buffer.name()
                && shape.length == buffer.length(&scene.sizes) as u64
                && index == (buffer.element() == Element::Index)
        };
        if buffers.len() != data.len() || !buffers.iter().zip(head.arrays.iter().zip(&data)).all(fits) {
            return Err(useless("its arrays are not those that its case needs".to_owned()));
        }
        if head.progress.motion.is_some() != scene.plan.moves() {
            return Err(useless("how its motion began does not go with its case".to_owned()));
        }
        let state = State { progress: head.progress, arrays: buffers.into_iter().zip(data).collect() };
        match state.non_finite(scene) {
            Some(field) => Err(useless(format!("{} of point {} is not finite", field.buffer.name(), field.point))),
            None => Ok(state),
        }
    }
}

/// The length of the head, from the first bytes of a file.
fn head_length(bytes: &[u8]) -> Result<usize, CheckpointTrouble> {
    let short = CheckpointTrouble::Length { found: bytes.len() as u64, expected: (FRONT + BACK) as u64 };
    if !bytes.starts_with(&KIND[..bytes.len().min(KIND.len())]) || bytes.is_empty() {
        return Err(CheckpointTrouble::Foreign);
    }
    let word = |at: usize| bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes);
    let (Some(version), Some(length)) = (word(8), word(12)) else { return Err(short) };
    match version {
        0 => Err(CheckpointTrouble::Foreign),
        VERSION if length as usize <= LONGEST_HEAD => Ok(length as usize),
        VERSION => Err(CheckpointTrouble::Altered),
        found => Err(CheckpointTrouble::Newer { found }),
    }
}

fn refuse(path: &Path, trouble: CheckpointTrouble) -> OutputError {
    OutputError::Checkpoint { path: path.to_owned(), trouble }
}
