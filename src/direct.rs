//! A sparse direct solve of the pressure equation, by faer, on the host, in f64.
//!
//! The independent check of the iterative solvers, their fallback when one stalls, and a solver in its own right: on points that
//! stand still the factorisation is made once. Both matrices are singular by the constants. The symmetric one is
//! grounded at its last point and factorised by Cholesky. The collocated one is solved with a Lagrange multiplier
//! `lambda` on the mean, `A p + lambda v = b`, `v` 1 inside and 0 on walls: row `k` is replaced by `p_k = 0`, and the two solutions
//! for `b` and for `v` are put together so that row `k` holds too.

use faer::linalg::solvers::{ShapeCore, Solve};
use faer::sparse::linalg::solvers::{Llt, Lu};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};

use crate::case::PressureForm;
use crate::cloud::voronoi::Cells;
use crate::cpu::blocks;
use crate::cpu::operations::moving::density;
use crate::engine::{Data, EngineError};
use crate::scene::Scene;
use crate::step::{Buffer, Points};

/// A pressure matrix, factorised.
pub struct DirectSolver(Factor);

enum Factor {
    Symmetric(Llt<usize, f64>),
    /// With points where the pressure is 0.
    Grounded(Llt<usize, f64>),
    General {
        lu: Box<Lu<usize, f64>>,
        rows: Vec<Vec<(usize, f64)>>,
        /// The solution for `v`.
        inside: Vec<f64>,
    },
    /// Regular: the pressure is given somewhere.
    Regular {
        lu: Box<Lu<usize, f64>>,
        rows: Vec<Vec<(usize, f64)>>,
    },
}

impl DirectSolver {
    /// Factorises the matrix of the scene's form. `read` gives the arrays that an engine has assembled.
    pub fn new(scene: &Scene, read: &mut dyn FnMut(Buffer) -> Result<Data, EngineError>) -> Result<Self, EngineError> {
        if let Some(cells) = scene.cells() {
            return match scene.constants.singular {
                true => Self::conservative(cells),
                false => Self::grounded(cells, &|point| scene.is_outlet(point)),
            };
        }
        let rows = collocated_rows(scene, read)?;
        if scene.plan.moves() {
            let sign = if scene.plan.form == Some(PressureForm::Integral) { -1.0 } else { 1.0 };
            return Self::regular(rows, sign);
        }
        match scene.constants.singular {
            true => Self::collocated(rows, scene.constants.shift.rows),
            false => Self::regular(rows, 1.0),
        }
    }

    /// The matrix `K` of the conservative form.
    pub fn conservative(cells: &Cells) -> Result<Self, EngineError> {
        let kept = cells.volume.len() - 1;
        let mut entries = Vec::with_capacity(4 * kept);
        for point in 0..kept {
            entries.push(Triplet::new(point, point, cells.faces(point).map(|(_, weight)| weight).sum()));
            let lower = cells.faces(point).filter(|&(other, _)| other < point);
            entries.extend(lower.map(|(other, weight)| Triplet::new(point, other, -weight)));
        }
        let matrix = sparse(kept, &entries)?;
        matrix.sp_cholesky(Side::Lower).map(|factor| Self(Factor::Symmetric(factor))).map_err(failed)
    }

    /// The same where the pressure is 0 at some points.
    fn grounded(cells: &Cells, held: &dyn Fn(usize) -> bool) -> Result<Self, EngineError> {
        let mut entries = Vec::with_capacity(4 * cells.volume.len());
        for point in 0..cells.volume.len() {
            let free = !held(point);
            let own = if free { cells.faces(point).map(|(_, weight)| weight).sum() } else { 1.0 };
            entries.push(Triplet::new(point, point, own));
            let lower = cells.faces(point).filter(|&(other, _)| free && other < point && !held(other));
            entries.extend(lower.map(|(other, weight)| Triplet::new(point, other, -weight)));
        }
        let matrix = sparse(cells.volume.len(), &entries)?;
        matrix.sp_cholesky(Side::Lower).map(|factor| Self(Factor::Grounded(factor))).map_err(failed)
    }

    /// A matrix whose rows sum to zero, row by row: column and value; the multiplier is in the first `shifted`, those inside.
    pub fn collocated(rows: Vec<Vec<(usize, f64)>>, shifted: usize) -> Result<Self, EngineError> {
        // Any interior row will do; the first is one.
        let entries: Vec<_> =
            std::iter::once(Triplet::new(0, 0, 1.0))
                .chain(rows.iter().enumerate().skip(1).flat_map(|(point, row)| {
                    row.iter().map(move |&(column, value)| Triplet::new(point, column, value))
                }))
                .collect();
        let lu = sparse(rows.len(), &entries)?.sp_lu().map_err(failed)?;
        let inside: Vec<f64> = (0..rows.len()).map(|row| f64::from(u8::from(0 < row && row < shifted))).collect();
        let inside = solve(&lu, &inside);
        Ok(Self(Factor::General { lu: Box::new(lu), rows, inside }))
    }

    /// A matrix whose rows sum to zero, times `sign`, but for empty ones: there the pressure is given.
    fn regular(mut rows: Vec<Vec<(usize, f64)>>, sign: f64) -> Result<Self, EngineError> {
        for (point, row) in rows.iter_mut().enumerate() {
            row.iter_mut().for_each(|(_, value)| *value *= sign);
            if row.iter().all(|&(_, value)| value == 0.0) {
                *row = vec![(point, 1.0)];
            }
        }
        let entries: Vec<_> = rows
            .iter()
            .enumerate()
            .flat_map(|(point, row)| row.iter().map(move |&(column, value)| Triplet::new(point, column, value)))
            .collect();
        let lu = sparse(rows.len(), &entries)?.sp_lu().map_err(failed)?;
        Ok(Self(Factor::Regular { lu: Box::new(lu), rows }))
    }

    /// The pressure, of mean zero where only its differences count, for a right side of one entry a point, Pa.
    pub fn solve(&self, source: &[f64]) -> Result<Vec<f64>, EngineError> {
        let mut pressure = match &self.0 {
            Factor::Symmetric(factor) => {
                let points = factor.ncols() + 1;
                let mean = source[..points].iter().sum::<f64>() / points as f64;
                let right: Vec<f64> = source[..points - 1].iter().map(|b| b - mean).collect();
                let mut pressure = solve(factor, &right);
                pressure.push(0.0);
                pressure
            }
            Factor::Regular { lu, rows } => return finite(solve(lu.as_ref(), &source[..rows.len()])),
            Factor::Grounded(factor) => return finite(solve(factor, &source[..factor.ncols()])),
            Factor::General { lu, rows, inside } => {
                let mut right = source[..rows.len()].to_vec();
                right[0] = 0.0;
                let pressure = solve(lu.as_ref(), &right);
                let along = |x: &[f64]| product(&rows[0], x);
                let multiplier = (source[0] - along(&pressure)) / (1.0 - along(inside));
                pressure.iter().zip(inside).map(|(p, inside)| p - multiplier * inside).collect()
            }
        };
        let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
        pressure.iter_mut().for_each(|p| *p -= mean);
        finite(pressure)
    }

    /// Root mean square of what a pressure leaves of the source, `b - A p` less its mean over the rows that a multiplier is in, as
    /// the iterative solvers measure it: over the volume in the conservative form.
    pub fn residual(&self, scene: &Scene, source: &[f64], pressure: &[f64]) -> f64 {
        let of = |point: usize| match (&self.0, scene.cells()) {
            (Factor::General { rows, .. } | Factor::Regular { rows, .. }, _) => {
                source[point] - product(&rows[point], pressure)
            }
            (Factor::Grounded(_), _) if scene.is_outlet(point) => source[point],
            (_, Some(cells)) => {
                let own = pressure[point];
                source[point] - cells.faces(point).map(|(other, weight)| weight * (own - pressure[other])).sum::<f64>()
            }
            _ => source[point],
        };
        let mut left: Vec<f64> = (0..scene.sizes.points).map(of).collect();
        let points = left.len() as f64;
        let shifted = &mut left[..scene.constants.shift.rows];
        let mean = shifted.iter().sum::<f64>() / shifted.len().max(1) as f64;
        shifted.iter_mut().for_each(|r| *r -= mean);
        if let Some(cells) = scene.cells() {
            left.iter_mut().zip(&cells.volume).for_each(|(r, volume)| *r /= volume);
        }
        let unit = match scene.plan.form {
            Some(PressureForm::Integral) => density::per_area(scene.constants.lattice),
            _ => 1.0,
        };
        unit * (left.iter().map(|r| r * r).sum::<f64>() / points).sqrt()
    }
}

fn finite(pressure: Vec<f64>) -> Result<Vec<f64>, EngineError> {
    match pressure.iter().all(|p| p.is_finite()) {
        true => Ok(pressure),
        false => Err(EngineError::Direct("the direct solve gave no finite pressure".to_owned())),
    }
}

fn product(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|&(column, value)| value * x[column]).sum()
}

/// The rows of the collocated matrix, diagonal included, from the arrays of an engine.
pub fn collocated_rows(
    scene: &Scene,
    read: &mut dyn FnMut(Buffer) -> Result<Data, EngineError>,
) -> Result<Vec<Vec<(usize, f64)>>, EngineError> {
    let standing = Points::Standing;
    let mut index = |buffer| match read(buffer)? {
        Data::Index(values) => Ok(values),
        Data::Real(_) => Err(EngineError::Absent(buffer)),
    };
    let (neighbours, count) = (index(Buffer::Neighbours(standing))?, index(Buffer::NeighbourCount(standing))?);
    let Data::Real(row) = read(Buffer::MatrixRow)? else { return Err(EngineError::Absent(Buffer::MatrixRow)) };
    let slots = scene.sizes.capacity;
    let rows = (0..scene.sizes.points).map(|point| {
        let at = |slot: usize| blocks::at(point, slot, slots);
        let mut entries: Vec<(usize, f64)> =
            (0..count[point] as usize).map(|slot| (neighbours[at(slot)] as usize, row[at(slot)])).collect();
        let diagonal = -entries.iter().map(|&(_, value)| value).sum::<f64>();
        entries.push((point, diagonal));
        entries
    });
    Ok(rows.collect())
}

fn sparse(size: usize, entries: &[Triplet<usize, usize, f64>]) -> Result<SparseColMat<usize, f64>, EngineError> {
    SparseColMat::try_new_from_triplets(size, size, entries).map_err(failed)
}

fn solve(factor: &impl Solve<f64>, right: &[f64]) -> Vec<f64> {
    let right = Mat::from_fn(right.len(), 1, |row, _| right[row]);
    let solution = factor.solve(&right);
    (0..solution.nrows()).map(|row| solution[(row, 0)]).collect()
}

fn failed(error: impl std::fmt::Debug) -> EngineError {
    EngineError::Direct(format!("the sparse factorisation failed: {error:?}"))
}
