//! From a case to what runs: the operations in order, and the arrays that they need.

mod moving;
mod once;
mod rows;
mod standing;

use serde::Serialize;

use super::{Buffer, Carried, Element, Operation, Points};
use crate::case::{Case, Motion, PressureForm, Problem, Solver, Splitting};

/// How many of everything there are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Sizes {
    pub points: usize,
    pub interior: usize,
    /// Points that have a pressure: all but those behind the walls of MPS.
    pub pressured: usize,
    /// Most neighbours that a point's list holds.
    pub capacity: usize,
    /// Most faces that a cell has.
    pub face_capacity: usize,
    /// Most points that the flux out of a cell is made of.
    pub flux_capacity: usize,
    /// Most points that the velocity of a point of a slip side or an outlet is made of.
    pub open_capacity: usize,
    /// Cells of the neighbour search.
    pub cells: usize,
    /// Coefficients of a fit.
    pub coefficients: usize,
    /// Places of the cells, or aggregates, of the coarse pressure; 0 without it.
    pub coarse: usize,
    /// Parts of the aggregates; 0 without them, as below.
    pub parts: usize,
    /// Links between them, and what whole blocks have beside.
    pub links: usize,
}

/// What a scene runs, as data. The same plan drives both engines; `stillpoint plan` prints it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Done once, in order.
    pub setup: Vec<Operation>,
    /// Done whenever the length of a step changes: what of the drift depends on nothing else. Of a prescribed velocity alone.
    pub on_step: Vec<Operation>,
    /// The drift: carries the velocity along the flow. Empty without advection but for `KeepVelocity`.
    pub drift: Vec<Operation>,
    /// The kick: forces, pressure, correction.
    pub kick: Vec<Operation>,
    /// The pressure equation, where the scene has one.
    pub form: Option<PressureForm>,
    pub splitting: Splitting,
    /// Fluid comes and goes through the sides.
    pub through_flow: bool,
    /// Fluid leaves through some side, where the pressure is 0.
    pub outlets: bool,
    /// Scalar fields that the flow carries.
    pub carried: Vec<Carried>,
    /// True of a flow in time; else `kick` is all there is to do, once.
    pub flows: bool,
    /// What becomes of the points that the flow has moved.
    pub motion: Motion,
    /// Points that stand still: their pressure matrix is summed up over aggregates, for conjugate gradients.
    pub aggregates: bool,
}

fn solve_by(solver: Solver) -> Operation {
    match solver {
        Solver::ConjugateGradient => Operation::ConjugateGradient,
        Solver::Bicgstab => Operation::Bicgstab,
        Solver::Direct => Operation::DirectSolve,
    }
}

impl Plan {
    pub fn new(case: &Case) -> Self {
        match case.problem() {
            Problem::Flow if case.moves() => Self::of_moving(case),
            Problem::Flow => Self::of_flow(case),
            Problem::Derivatives(_) => Self::of_derivatives(case),
            Problem::Poisson(_) => Self::of_poisson(case),
        }
    }

    /// True where walls mirror the fluid; else they are made of points.
    pub fn mirrors(&self) -> bool {
        self.moves() && self.form == Some(PressureForm::Collocated)
    }

    /// True where a coarse pressure helps the solver.
    pub fn coarsens(&self) -> bool {
        self.aggregates || self.coarsens_over_cells()
    }

    /// True where that is of the cells of the neighbour search, anew in every step.
    pub fn coarsens_over_cells(&self) -> bool {
        self.kick.contains(&Operation::Coarsen)
    }

    /// True where the points stay where they have moved to.
    pub fn moves(&self) -> bool {
        self.motion != Motion::Fixed
    }

    /// Every operation, setup first.
    pub fn operations(&self) -> impl Iterator<Item = Operation> + '_ {
        self.setup.iter().chain(&self.on_step).chain(&self.drift).chain(&self.kick).copied()
    }

    /// The velocity that moves the points.
    pub fn moving(&self) -> Buffer {
        match self.splitting {
            Splitting::Reflection => Buffer::Reflected,
            Splitting::Projection => Buffer::Projected,
        }
    }

    /// The arrays that hold the pressure matrix.
    pub fn matrix(&self) -> Vec<Buffer> {
        match self.form {
            Some(PressureForm::Conservative) => {
                vec![Buffer::FaceNeighbours, Buffer::FaceWeight, Buffer::FaceCount]
            }
            Some(PressureForm::Collocated | PressureForm::Integral) => {
                let points = Points::Standing;
                vec![Buffer::Neighbours(points), Buffer::NeighbourCount(points), Buffer::MatrixRow]
            }
            None => Vec::new(),
        }
    }

    /// True where some operation goes through the faces of the Voronoi cells.
    pub fn has_faces(&self) -> bool {
        let diffuses =
            |operation: &Operation| matches!(operation, Operation::Diffuse(..) | Operation::ImplicitViscosity);
        self.form == Some(PressureForm::Conservative) || self.kick.iter().any(diffuses)
    }

    /// The lists of points around each point that the search for the nearest point walks along: those across the faces
    /// where there are faces, else all neighbours; and how many of each list are in use.
    pub fn around(&self) -> [Buffer; 2] {
        match self.form {
            // The cells of outlets have no faces.
            Some(PressureForm::Conservative) if !self.outlets => [Buffer::FaceNeighbours, Buffer::FaceCount],
            _ => [Buffer::Neighbours(Points::Standing), Buffer::NeighbourCount(Points::Standing)],
        }
    }

    /// Slots of those lists.
    pub fn around_capacity(&self, sizes: &Sizes) -> usize {
        match self.form {
            Some(PressureForm::Conservative) if !self.outlets => sizes.face_capacity,
            _ => sizes.capacity,
        }
    }

    /// The viscous term and the source reach the walls too: the collocated wall rows need `u*` there.
    pub fn forces_reach_walls(&self) -> bool {
        self.form == Some(PressureForm::Collocated)
    }

    /// Every array that some operation touches, and those that the reports of a flow need; in a fixed order.
    pub fn buffers(&self) -> Vec<Buffer> {
        let mut buffers: Vec<Buffer> =
            self.operations().flat_map(|operation| [operation.reads(self), operation.writes()].concat()).collect();
        if self.flows {
            buffers.extend([Buffer::Volume, Buffer::Reported, Buffer::Projected, Buffer::Velocity]);
        }
        buffers.sort_unstable();
        buffers.dedup();
        buffers
    }

    /// The arrays that a run needs, beside what the scene begins with and the setup makes of it, to go on from between two
    /// steps as if it had not been away: those that a step changes and that it, or a report, reads before they are written.
    pub fn state(&self) -> Vec<Buffer> {
        let step: Vec<Operation> = self.drift.iter().chain(&self.kick).copied().collect();
        // Of a velocity that stays too: what is reported can be made from the state alone.
        let mut changed = vec![Buffer::Projected, Buffer::Reported];
        let mut needed = vec![Buffer::Projected, Buffer::Reported];
        if self.splitting == Splitting::Reflection {
            needed.extend([Buffer::Reflected, Buffer::PressureKick]);
        }
        if self.form.is_some() {
            needed.push(Buffer::Pressure);
        }
        let mut filled = Vec::new();
        for operation in step {
            let (writes, fills) = (operation.writes(), operation.fills());
            let read = operation.reads(self).into_iter().chain(writes.iter().copied().filter(|b| !fills.contains(b)));
            needed.extend(read.filter(|buffer| !filled.contains(buffer)));
            changed.extend(writes);
            filled.extend(fills);
        }
        needed.retain(|buffer| changed.contains(buffer));
        needed.sort_unstable();
        needed.dedup();
        needed
    }

    /// Bytes of one array, for floats of `real` bytes.
    pub fn bytes(&self, buffer: Buffer, sizes: &Sizes, real: usize) -> usize {
        let entry = match buffer.element() {
            Element::Real => real,
            Element::Index => 4,
        };
        buffer.length(sizes) * entry
    }

    /// Bytes of all arrays.
    pub fn total_bytes(&self, sizes: &Sizes, real: usize) -> usize {
        self.buffers().into_iter().map(|buffer| self.bytes(buffer, sizes, real)).sum()
    }
}
