//! The arrays of the engine as the operations take them.

use super::CpuEngine;
use crate::cpu::operations::conservative::{Faces, Fluxes};
use crate::cpu::operations::derivative::{Gradient, Laplacian};
use crate::cpu::operations::fits::Fits;
use crate::cpu::operations::integral::Means;
use crate::cpu::operations::lists::Lists;
use crate::cpu::operations::neighbours::Search;
use crate::cpu::operations::remap::{Around, Moving};
use crate::cpu::operations::space::Space;
use crate::cpu::real::Real;
use crate::engine::EngineError;
use crate::step::{Buffer, Points};

impl<T: Real> CpuEngine<T> {
    pub(super) fn fits<S: Space<T>, const N: usize, const F: usize>(
        &self,
        points: Points,
        space: S,
    ) -> Result<Fits<'_, T, S, N, F>, EngineError> {
        Ok(Fits {
            position: self.fields.real(Buffer::Position(points))?,
            support: self.fields.real(Buffer::Support(points))?,
            lists: self.lists(points)?,
            factor: self.fields.real(Buffer::Factor(points))?,
            weight: self.scene.constants.weight,
            space,
        })
    }

    pub(super) fn lists(&self, points: Points) -> Result<Lists<'_>, EngineError> {
        Ok(Lists {
            neighbours: self.fields.index(Buffer::Neighbours(points))?,
            count: self.fields.index(Buffer::NeighbourCount(points))?,
            capacity: self.scene.sizes.capacity,
        })
    }

    pub(super) fn laplacian(&self) -> Result<Laplacian<'_, T>, EngineError> {
        Ok(Laplacian { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::LaplacianRow)? })
    }

    pub(super) fn gradient(&self) -> Result<Gradient<'_, T>, EngineError> {
        Ok(Gradient { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::GradientRow)? })
    }

    pub(super) fn means<S: Space<T>>(&self, space: S) -> Result<Means<'_, T, S>, EngineError> {
        let points = Points::Standing;
        Ok(Means {
            position: self.fields.real(Buffer::Position(points))?,
            support: self.fields.real(Buffer::Support(points))?,
            lists: self.lists(points)?,
            lattice: self.scene.constants.lattice,
            space,
        })
    }

    pub(super) fn search<S: Space<T>>(&self, points: Points, space: S) -> Result<Search<'_, T, S>, EngineError> {
        Ok(Search {
            position: self.fields.real(Buffer::Position(points))?,
            points: self.scene.sizes.points,
            grid: &self.scene.constants.grid,
            start: self.fields.index(Buffer::CellStart(points))?,
            sorted: self.fields.index(Buffer::CellPoints(points))?,
            space,
        })
    }

    pub(super) fn faces(&self) -> Result<Faces<'_, T>, EngineError> {
        Ok(Faces {
            neighbours: self.fields.index(Buffer::FaceNeighbours)?,
            weight: self.fields.real(Buffer::FaceWeight)?,
            count: self.fields.index(Buffer::FaceCount)?,
            capacity: self.scene.sizes.face_capacity,
        })
    }

    pub(super) fn fluxes(&self) -> Result<Fluxes<'_, T>, EngineError> {
        Ok(Fluxes {
            points: self.fields.index(Buffer::FluxPoints)?,
            count: self.fields.index(Buffer::FluxCount)?,
            row: self.fields.real(Buffer::FluxRow)?,
            capacity: self.scene.sizes.flux_capacity,
        })
    }

    pub(super) fn moving<S: Space<T>>(&self, space: S) -> Result<Moving<'_, T, S>, EngineError> {
        Ok(Moving {
            space,
            position: self.standing(Buffer::Position)?,
            support: self.standing(Buffer::Support)?,
            values: self.fields.real(self.scene.plan.moving())?,
            coefficients: self.fields.real(Buffer::Coefficients)?,
            trace: T::from_f64(self.scene.constants.trace),
        })
    }

    pub(super) fn around(&self) -> Result<Around<'_>, EngineError> {
        let [around, count] = self.scene.plan.around();
        Ok(Around {
            neighbours: self.fields.index(around)?,
            count: self.fields.index(count)?,
            capacity: self.scene.plan.around_capacity(&self.scene.sizes),
        })
    }

    /// The points that a force acts on: all where the wall rows of the pressure need it, else those inside.
    pub(super) fn forced(&self) -> usize {
        let sizes = &self.scene.sizes;
        if self.scene.plan.forces_reach_walls() { sizes.points } else { sizes.interior }
    }

    pub(super) fn standing(&self, buffer: fn(Points) -> Buffer) -> Result<&[T], EngineError> {
        self.fields.real(buffer(Points::Standing))
    }
}
