//! How far the GPU's numbers may lie from the CPU's, derived from the CPU's own rounding, and where they lie farther.

use stillpoint::engine::Data;
use stillpoint::scene::Scene;
use stillpoint::step::{BLOCK, Buffer, Element, Operation};

/// GPU f32 and CPU f32 each lie within about one rounding error of CPU f64, so within two of each other. The largest of a few
/// hundred errors of another order of summation may be twice that of ours.
pub const FACTOR: f64 = 4.0;
/// Where CPU f32 happens to round nothing, as many units in the last place of an array's largest number.
const UNITS: f64 = 4.0;

/// An entry where the engines differ by more than rounding.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    pub operation: Operation,
    pub buffer: Buffer,
    /// The point; of an array with one entry a cell, the cell.
    pub point: usize,
    pub single: f64,
    pub gpu: f64,
    pub allowed: f64,
}

/// One array as the three engines left it.
pub struct Results<'a> {
    pub double: &'a Data,
    pub single: &'a Data,
    pub gpu: &'a Data,
}

/// The entries of one array that count, as they are compared.
struct Entries {
    /// Whose each entry is.
    points: Vec<usize>,
    single: Vec<f64>,
    gpu: Vec<f64>,
    allowed: f64,
}

impl Entries {
    fn new(scene: &Scene, buffer: Buffer, results: &Results, slack: f64) -> Self {
        let (entries, points): (Vec<_>, _) = entries(scene, buffer).unzip();
        let of = |data: &Data| {
            let values: Vec<f64> = match data {
                Data::Real(values) => entries.iter().map(|&entry| values[entry]).collect(),
                Data::Index(values) => entries.iter().map(|&entry| f64::from(values[entry])).collect(),
            };
            // The pressure equation leaves the mean free.
            if buffer == Buffer::Pressure { without_mean(values) } else { values }
        };
        let [double, single, gpu] = [results.double, results.single, results.gpu].map(of);
        let allowed = match buffer.element() {
            Element::Real => slack * rounding(&double, &single),
            // Indexes are equal or they differ: no scene has a point within rounding of a cell's edge or of a neighbour's
            // radius, or a pivot within rounding of the threshold.
            Element::Index => 0.0,
        };
        Self { points, single, gpu, allowed }
    }

    /// Numbers that are none are farther away than any other.
    fn distance(&self, k: usize) -> f64 {
        let off = (self.single[k] - self.gpu[k]).abs();
        if off.is_nan() { f64::INFINITY } else { off }
    }
}

fn rounding(double: &[f64], single: &[f64]) -> f64 {
    let rounding = double.iter().zip(single).map(|(a, b)| (a - b).abs()).fold(0.0, most);
    let size = double.iter().map(|value| value.abs()).fold(0.0, most);
    FACTOR * rounding + UNITS * f64::from(f32::EPSILON) * size
}

/// The larger of two, and NaN where either is: nothing is allowed then.
fn most(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// By how much the engines may differ in an array; `slack` times rounding.
pub fn allowed(scene: &Scene, buffer: Buffer, results: &Results, slack: f64) -> f64 {
    Entries::new(scene, buffer, results, slack).allowed
}

/// The entry that differs most, if by more than is allowed.
pub fn compare(
    scene: &Scene,
    operation: Operation,
    buffer: Buffer,
    results: &Results,
    slack: f64,
) -> Option<Difference> {
    let entries = Entries::new(scene, buffer, results, slack);
    let worst = (0..entries.gpu.len()).max_by(|&a, &b| entries.distance(a).total_cmp(&entries.distance(b)))?;
    // Not `>`: nothing compares with NaN.
    let agrees = entries.distance(worst) <= entries.allowed;
    (!agrees).then(|| Difference {
        operation,
        buffer,
        point: entries.points[worst],
        single: entries.single[worst],
        gpu: entries.gpu[worst],
        allowed: entries.allowed,
    })
}

/// The entries of an array that belong to points, or to cells, and whose they are; those of the padding belong to none.
pub fn entries(scene: &Scene, buffer: Buffer) -> impl Iterator<Item = (usize, usize)> + use<> {
    let sizes = scene.sizes;
    let width = buffer.per_point(&sizes);
    let owner = move |entry: usize| match width {
        None => entry,
        // Interleaved; one number a point is its own case.
        Some(width @ 1..=2) => entry / width,
        Some(width) => entry / (BLOCK * width) * BLOCK + entry % BLOCK,
    };
    let count = match width {
        Some(_) => sizes.points,
        None => buffer.length(&sizes),
    };
    (0..buffer.length(&sizes)).map(move |entry| (entry, owner(entry))).filter(move |&(_, owner)| owner < count)
}

fn without_mean(values: Vec<f64>) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.into_iter().map(|value| value - mean).collect()
}
