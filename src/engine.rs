//! What both engines are to the rest: arrays to write and read, operations to apply, steps to advance.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::step::{Buffer, Element, Operation};

/// The entries of one array, as the host holds them.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    Real(Vec<f64>),
    Index(Vec<u32>),
}

impl Data {
    /// Without entries.
    pub fn empty(element: Element) -> Self {
        match element {
            Element::Real => Data::Real(Vec::new()),
            Element::Index => Data::Index(Vec::new()),
        }
    }

    /// The first entry that is no finite number.
    pub fn first_non_finite(&self) -> Option<usize> {
        match self {
            Data::Real(values) => first_lost(values, |value| !value.is_finite()),
            Data::Index(_) => None,
        }
    }
}

/// Lengths in time of the parts of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// How long the points move, s.
    pub dt: f64,
    /// How long the forces act before the projection, s: half of `dt` (reflection) or all of it (projection).
    pub kick: f64,
    /// Second half of the kick over the first; 1 unless dt changes. 0 makes a first half kick alone.
    pub second_kick: f64,
    /// Share of what a step of the usual length does to keep points that move evenly spread: of the shift and of the density term, and,
    /// squared, of the longest push of the pressure. 1, but less in steps that are shorter: what is done in a second does not depend on them.
    pub share: f64,
}

/// Who computes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EngineInfo {
    /// `cpu` or `gpu`.
    pub engine: &'static str,
    pub adapter: Option<AdapterInfo>,
    /// `f32` or `f64`.
    pub precision: &'static str,
}

/// The GPU, or the program that stands in for one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdapterInfo {
    pub name: String,
    pub backend: String,
    pub driver: String,
    pub driver_info: String,
    /// True for an adapter that runs on the CPU.
    pub software: bool,
}

/// What an iterative solve did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct SolveInfo {
    pub iterations: u32,
    /// Root mean square of `r_i / V_i` before the first iteration, in units of the source over volume.
    pub first_residual: f64,
    /// The same at the end, recomputed from the solution.
    pub last_residual: f64,
    pub outcome: Outcome,
}

/// How an iterative solve ended.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    #[default]
    Converged,
    /// The residual stopped falling, or the iterations ran out, above what was asked for.
    Stagnated,
    /// A quantity that must be positive was not, or not finite.
    BrokeDown,
}

/// What `advance` did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Advance {
    /// Steps done: all that were asked for, unless a field turned non-finite.
    pub steps: u32,
    /// Pressure iterations of all these steps.
    pub iterations: u64,
    /// Solves that were handed to the direct solver since the last call, those of single operations among them.
    pub fallbacks: u32,
    pub trouble: Option<NonFinite>,
}

/// A field that is no longer a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NonFinite {
    pub buffer: Buffer,
    pub point: usize,
}

/// Sums over the points, for a row of diagnostics.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measurement {
    /// `sum V |u|^2 / 2`, m^4/s^2.
    pub kinetic_energy: f64,
    /// m/s
    pub max_speed: f64,
    /// Root mean square of `div u`, 1/s.
    pub divergence: f64,
    /// Largest `|u - u_reported|` over the time since, m/s^2.
    pub change: f64,
}

/// Entries that are looked at together.
const STRIDE: usize = 64;

/// The first entry that is `lost`. Looks at many at once: nearly always none is.
pub fn first_lost<V: Copy>(values: &[V], lost: impl Fn(V) -> bool) -> Option<usize> {
    let some = |values: &[V]| values.iter().fold(false, |some, &value| some | lost(value));
    let begin = STRIDE * values.chunks(STRIDE).position(some)?;
    values[begin..].iter().position(|&value| lost(value)).map(|entry| begin + entry)
}

/// Why an engine cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EngineError {
    #[error("{0}")]
    Adapter(String),
    #[error("the device needs {needed} bytes for {what}, and allows {allowed}; use fewer points or the CPU engine")]
    TooLarge { what: String, needed: u64, allowed: u64 },
    #[error("the device has no memory left for {what}; use fewer points or the CPU engine")]
    OutOfMemory { what: String },
    #[error("GPU: the driver does not take the shader {name}: {message}; use the CPU engine")]
    Shader { name: String, message: String },
    #[error("a point has {found} neighbours, and its list holds {capacity}: the points have clustered")]
    NeighbourOverflow { found: u32, capacity: usize },
    #[error("GPU: {0}")]
    Device(String),
    #[error("{buffer:?} holds {expected} entries, not {given}")]
    Length { buffer: Buffer, expected: usize, given: usize },
    #[error("this plan stores no {0:?}")]
    Absent(Buffer),
    #[error("{buffer:?} entry {entry}: index {index} is out of range")]
    Index { buffer: Buffer, entry: usize, index: u32 },
    #[error("pressure: {0}")]
    Direct(String),
    #[error("viscosity: its solve came no further than a residual of {residual:e} m/s in {iterations} iterations")]
    Viscosity { residual: f64, iterations: u32 },
}

impl EngineError {
    /// The solve of implicit viscosity stands still.
    pub(crate) fn viscosity(solve: &SolveInfo) -> Self {
        Self::Viscosity { residual: solve.last_residual, iterations: solve.iterations }
    }
}

/// Seconds spent in each operation.
pub type Spent = BTreeMap<Operation, f64>;

/// A place where steps are computed.
pub trait Engine {
    fn info(&self) -> EngineInfo;

    /// Replaces a whole array, padding included.
    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError>;

    /// A whole array, padding included.
    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError>;

    /// The same of several, into memory at hand; the first of all their entries that is no finite number.
    fn read_all(&mut self, arrays: &mut [(Buffer, Data)]) -> Result<Option<(Buffer, usize)>, EngineError> {
        let mut lost = None;
        for (buffer, data) in arrays {
            *data = self.read(*buffer)?;
            lost = lost.or_else(|| data.first_non_finite().map(|entry| (*buffer, entry)));
        }
        Ok(lost)
    }

    /// Runs one operation on what is stored.
    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError>;

    /// Drifts and kicks `steps` times; ends early at a field that is not finite.
    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError>;

    /// Of the last pressure solve.
    fn solve_info(&self) -> SolveInfo;

    /// Of the last solve of implicit viscosity; `None` without.
    fn viscous_solve_info(&self) -> Option<SolveInfo> {
        None
    }

    /// Seconds spent in each operation since the engine was made; empty where the engine takes no times.
    fn seconds(&self) -> Spent {
        Spent::default()
    }

    /// Measures the projected velocity and remembers it; `elapsed` is the time since the last measurement, s.
    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError>;
}
