//! From a case to what runs: the operations in order, and the arrays that they need.

use serde::Serialize;

use super::{Buffer, Carried, Element, Kicked, Operation, Points, Stage};
use crate::case::{self, Case, Motion, Operators, PressureForm, Problem, Remap, Solver, Splitting};

/// How many of everything there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
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
    /// Places of the grids of the coarse pressure; 0 without it.
    pub coarse: usize,
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
}

fn solve_by(solver: Solver) -> Operation {
    match solver {
        Solver::ConjugateGradient => Operation::ConjugateGradient,
        Solver::Bicgstab => Operation::Bicgstab,
        Solver::Direct => Operation::DirectSolve,
    }
}

/// A solve that a coarse pressure helps along. The direct one needs no help.
fn coarse_solve(solver: Solver) -> Vec<Operation> {
    match solver {
        Solver::Direct => vec![Operation::DirectSolve],
        iterative => vec![Operation::Coarsen, solve_by(iterative)],
    }
}

/// The rows that a plan needs, and the form that they are of.
struct Rows {
    operators: Operators,
    /// Every point has its own radius.
    graded: bool,
    laplacian: bool,
    gradient: bool,
}

impl Rows {
    /// Everything up to the rows: the search for neighbours, the fits where something needs them.
    fn setup(&self, evaluates_fits: bool) -> Vec<Operation> {
        use Operation::*;
        let points = Points::Standing;
        let interpolation = self.operators == Operators::Interpolation;
        let find = if self.graded { FindLocalNeighbours } else { FindNeighbours(points) };
        let mut setup = vec![BuildCells(points), find];
        if interpolation || evaluates_fits {
            setup.extend([Factorise(points), WidenSupport(points)]);
        }
        if self.laplacian {
            setup.push(if interpolation { AssembleLaplacian } else { AssembleIntegralLaplacian });
        }
        if self.gradient {
            setup.push(if interpolation { AssembleGradient } else { AssembleIntegralGradient });
        }
        setup
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

    /// Derivatives of a known field, once.
    fn of_derivatives(case: &Case) -> Self {
        let interpolation = case.method.operators == Operators::Interpolation;
        let laplacian = case.method.second_derivatives();
        let setup = Rows { operators: case.method.operators, graded: false, laplacian, gradient: true }.setup(false);
        let mut kick = vec![Operation::Gradient];
        if laplacian {
            kick.push(Operation::Laplacian);
        }
        if !interpolation {
            kick.push(Operation::Average);
        }
        Self {
            setup,
            on_step: Vec::new(),
            drift: Vec::new(),
            kick,
            form: None,
            splitting: Splitting::Projection,
            through_flow: false,
            outlets: false,
            carried: Vec::new(),
            flows: false,
            motion: Motion::Fixed,
        }
    }

    /// The pressure equation with a known source, once.
    fn of_poisson(case: &Case) -> Self {
        let pressure = case.effects.pressure.clone().unwrap_or_default();
        let mut setup = Vec::new();
        if pressure.form() == PressureForm::Collocated {
            setup = Rows { operators: Operators::Interpolation, graded: false, laplacian: true, gradient: true }
                .setup(false);
            setup.push(Operation::AssembleCollocated);
        }
        let kick = vec![solve_by(pressure.solver())];
        Self {
            setup,
            on_step: Vec::new(),
            drift: Vec::new(),
            kick,
            form: Some(pressure.form()),
            splitting: Splitting::Projection,
            through_flow: false,
            outlets: false,
            carried: Vec::new(),
            flows: false,
            motion: Motion::Fixed,
        }
    }

    /// A flow whose points stay where they have moved to, or near there: everything that depends on their places is made
    /// anew in every step.
    fn of_moving(case: &Case) -> Self {
        use Operation::*;
        let effects = &case.effects;
        let (motion, standing) = (case.motion(), Points::Standing);
        let integral = case.method.operators == Operators::Integral;
        let pressure = effects.pressure.clone().unwrap_or_default();
        let (mut setup, mut drift, mut kick) = (Vec::new(), vec![KeepVelocity, ClearKick], Vec::new());
        let search = [BuildCells(standing), FindNeighbours(standing)];
        if effects.viscosity.is_some() {
            setup.extend(search);
            match integral {
                true => setup.push(AssembleIntegralLaplacian),
                false => setup.extend([FindSurface, FactoriseMirrored, FitMirrored]),
            }
            drift.push(if integral { Viscosity(Stage::Start) } else { FittedViscosity });
        }
        if effects.gravity.is_some() {
            drift.push(Gravity);
        }
        drift.push(Predict);
        if integral && effects.gravity.is_some() {
            // Gravity reached the walls' points.
            drift.push(HoldWalls);
        }
        drift.push(AdvancePoints);
        drift.extend(search);
        // The paper's interpolation form has nothing to hold points apart.
        if integral || motion == Motion::Shifted {
            drift.push(Collide);
        }
        kick.push(FindSurface);
        if integral {
            if effects.viscosity.is_some() {
                kick.push(AssembleIntegralLaplacian);
            }
            kick.push(AssembleDensity);
            kick.extend(coarse_solve(pressure.solver()));
            kick.push(match pressure.gradient() {
                case::Gradient::Corrected => CorrectByMoments,
                _ => CorrectByLeast,
            });
        } else {
            kick.extend([FactoriseMirrored, FitPredicted, AssembleMirrored]);
            kick.extend(coarse_solve(pressure.solver()));
            kick.push(CorrectMirrored);
            if motion == Motion::Shifted || effects.viscosity.is_some() {
                kick.push(FitMirrored);
            }
            if motion == Motion::Shifted {
                kick.push(ShiftPoints);
            }
        }
        kick.push(DisplacePoints);
        Self {
            setup,
            on_step: Vec::new(),
            drift,
            kick,
            form: Some(pressure.form()),
            splitting: Splitting::Projection,
            through_flow: false,
            outlets: false,
            carried: Vec::new(),
            flows: true,
            motion,
        }
    }

    /// True where walls mirror the fluid; else they are made of points.
    pub fn mirrors(&self) -> bool {
        self.moves() && self.form == Some(PressureForm::Collocated)
    }

    /// True where a coarse pressure helps the solver.
    pub fn coarsens(&self) -> bool {
        self.kick.contains(&Operation::Coarsen)
    }

    /// True where the points stay where they have moved to.
    pub fn moves(&self) -> bool {
        self.motion != Motion::Fixed
    }

    fn of_flow(case: &Case) -> Self {
        use Operation::*;
        let effects = &case.effects;
        let implicit = case.implicit_viscosity();
        let explicit = effects.viscosity.is_some() && !implicit;
        // Without a pressure or a velocity that is solved for there is nothing to reflect.
        let halves = effects.pressure.is_some() || implicit;
        let splitting = if halves { case.time.splitting } else { Splitting::Projection };
        // A kick of a whole step has no second half, but a mean pressure that implicit viscosity begins from.
        let reflects = splitting == Splitting::Reflection || implicit;
        let collocated = effects.pressure.as_ref().is_some_and(|pressure| pressure.form() == PressureForm::Collocated);
        let (through_flow, outlets) = (case.flows_through(), case.has_side(case::SideKind::Outlet));
        let standing = Points::Standing;
        let fits_faces =
            effects.pressure.as_ref().is_some_and(|pressure| pressure.divergence() == case::Divergence::Fit);
        let rows = Rows {
            operators: case.method.operators,
            graded: !case.cloud.refine.is_empty(),
            laplacian: explicit || collocated,
            gradient: effects.pressure.as_ref().is_some_and(|pressure| pressure.gradient() == case::Gradient::Fit),
        };
        // What carries the velocity evaluates fits, and so do reports where no cells measure the divergence.
        let cells = effects.pressure.is_some() && !collocated;
        let mut setup = rows.setup(effects.advection.is_some() || !cells);
        let (carried, diffusing) = (case.carried(), case.diffusing());
        // Half a step before the drift and half a step after: what is reported is of the time of the velocity.
        let mut diffusion = Vec::new();
        for &field in &diffusing {
            for stage in [Stage::Start, Stage::Middle] {
                diffusion.push(Diffuse(field, stage));
                if field == Carried::Temperature && case.has_heat_flux() {
                    diffusion.push(HeatWalls(stage));
                }
            }
        }
        let (mut on_step, mut drift) = (Vec::new(), diffusion.clone());
        match effects.advection.as_ref().map(|advection| advection.remap) {
            None if case.velocity_changes() => drift.push(KeepVelocity),
            None => {}
            Some(_) if !carried.is_empty() => {
                if case.velocity_changes() {
                    drift.extend([FitVelocity(standing), FindDepartures, CarryVelocity]);
                } else {
                    setup.push(FitVelocity(standing));
                    on_step.push(FindDepartures);
                }
                drift.extend(carried.iter().flat_map(|&field| [FitScalar(field), CarryScalar(field)]));
            }
            Some(Remap::Departure) => drift.extend([FitVelocity(standing), RemapDeparture]),
            Some(Remap::Forward) => {
                let moved = Points::Moved;
                drift.push(MovePoints);
                drift.extend([BuildCells(moved), FindNeighbours(moved), Factorise(moved), WidenSupport(moved)]);
                drift.extend([FitVelocity(moved), RemapForward]);
            }
        }
        let open = case.has_open_sides() && case.velocity_changes();
        if open && effects.advection.is_some() {
            drift.push(OpenSides(Kicked::Before));
        }
        // Forces that reach the walls, whose velocity is then put back.
        let pushes_walls = collocated || effects.gravity.is_some();
        let mut weight = Vec::new();
        if effects.gravity.is_some() {
            weight.push(Gravity);
        }
        if effects.buoyancy.is_some() {
            weight.push(Buoyancy);
        }
        let mut kick = diffusion;
        if case.velocity_changes() {
            kick.push(ClearKick);
        }
        kick.extend(&weight);
        if implicit {
            kick.extend([EstimateMiddle, ImplicitViscosity]);
            kick.extend(&weight);
            kick.push(ImplicitKick);
            if effects.pressure.is_some() {
                kick.push(PredictImplicit);
            }
        } else if explicit {
            kick.push(Viscosity(Stage::Start));
            if effects.drag.is_some() {
                kick.push(Drag);
            }
            if reflects {
                kick.push(EstimateMiddle);
                if pushes_walls {
                    kick.push(HoldWalls);
                }
                if open {
                    kick.push(OpenSides(Kicked::Within));
                }
                kick.extend(&weight);
                kick.push(Viscosity(Stage::Middle));
                if effects.drag.is_some() {
                    kick.push(Drag);
                }
            }
        }
        let lagged = implicit && effects.pressure.is_some();
        if case.velocity_changes() && !lagged {
            kick.push(Predict);
        }
        if let Some(pressure) = &effects.pressure {
            kick.push(match pressure.form() {
                PressureForm::Conservative if fits_faces => DivergenceByFit,
                PressureForm::Conservative => Divergence,
                PressureForm::Collocated | PressureForm::Integral => {
                    setup.push(AssembleCollocated);
                    if outlets {
                        setup.push(HoldOutlets);
                    }
                    CollocatedSource
                }
            });
            if through_flow && !collocated {
                kick.push(AddWallFlux);
            }
            if lagged {
                kick.push(AddMeanPressure);
            }
            kick.push(solve_by(pressure.solver()));
            if lagged {
                kick.push(Predict);
            }
            kick.push(match pressure.gradient() {
                case::Gradient::Adjoint => CorrectByAdjoint,
                _ => CorrectByFit,
            });
        }
        if pushes_walls {
            kick.push(HoldWalls);
        }
        if open {
            kick.push(OpenSides(Kicked::Within));
        }
        if reflects {
            kick.push(Reflect);
            if open {
                kick.push(OpenSides(Kicked::After));
            }
        }
        if let (Some(pressure), true) = (&effects.pressure, implicit) {
            kick.extend([
                RelaxPressure,
                match pressure.gradient() {
                    case::Gradient::Adjoint => MeanKickByAdjoint,
                    _ => MeanKickByFit,
                },
            ]);
        }
        Self {
            setup,
            on_step,
            drift,
            kick,
            form: effects.pressure.as_ref().map(|pressure| pressure.form()),
            splitting,
            through_flow,
            outlets,
            carried,
            flows: true,
            motion: Motion::Fixed,
        }
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
