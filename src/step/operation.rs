//! The operations: one name each, in three places: here, as a CPU function, as a WGSL file.

use serde::Serialize;

use super::{Buffer, Carried, Points};

/// Which velocity a force is taken of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Stage {
    /// The one that the kick begins from.
    Start,
    /// The estimate in the middle of the kick: second order (Heun's midpoint rule).
    Middle,
}

impl Stage {
    /// Where that velocity stands.
    pub fn velocity(self) -> Buffer {
        match self {
            Stage::Start => Buffer::Velocity,
            Stage::Middle => Buffer::Projected,
        }
    }
}

/// Which velocity it is, seen from the kick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Kicked {
    Before,
    /// In its middle: what is reported.
    Within,
    After,
}

impl Kicked {
    /// Where it stands.
    pub fn velocity(self) -> Buffer {
        match self {
            Kicked::Before => Buffer::Velocity,
            Kicked::Within => Buffer::Projected,
            Kicked::After => Buffer::Reflected,
        }
    }
}

/// What a solve is for. A step has at most one solve of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Equation {
    Pressure,
    /// Implicit viscosity.
    Viscosity,
}

impl Equation {
    pub const ALL: [Self; 2] = [Self::Pressure, Self::Viscosity];
}

/// One thing that an engine does to its arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Operation {
    /// Sorts the points into cells: count, running sum, scatter.
    BuildCells(Points),
    /// Lists the points within the radius of each point.
    FindNeighbours(Points),
    /// Lists the points within each point's own radius, where the spacing varies.
    FindLocalNeighbours,
    /// Forms and factorises the normal matrix of each point's least squares.
    Factorise(Points),
    /// Takes the points whose factorisation failed down the ladder: wider radius, lower order, nearest value.
    WidenSupport(Points),
    /// Rows of the fitted Laplacian: the factor of each neighbour's difference.
    AssembleLaplacian,
    /// Rows of the fitted gradient.
    AssembleGradient,
    /// Rows of the Laplacian as a weighted mean over neighbours, (2.4).
    AssembleIntegralLaplacian,
    /// Rows of the gradient as a weighted mean over neighbours, (2.3).
    AssembleIntegralGradient,
    /// Rows of the collocated pressure matrix: the Laplacian's inside, the normal derivative's at walls.
    AssembleCollocated,
    /// Takes the rows of outlets out of it, where the pressure is 0.
    HoldOutlets,

    /// Fits the velocity that moves the points.
    FitVelocity(Points),
    /// Evaluates the fits where the fluid came from: the velocity carried back to the standing points.
    RemapDeparture,
    /// Moves the interior points with the flow.
    MovePoints,
    /// Evaluates the fit of each moved point at its standing place (the paper's section 5).
    RemapForward,
    /// Finds where the fluid at every point came from, and the point nearest to there.
    FindDepartures,
    /// Evaluates the fits of the velocity there: as `RemapDeparture`, beside fields that the flow carries.
    CarryVelocity,
    /// Fits a field that the flow carries.
    FitScalar(Carried),
    /// Evaluates the fits of the field where the fluid came from.
    CarryScalar(Carried),
    /// Lets a carried field diffuse through the faces of the cells for half a step.
    Diffuse(Carried, Stage),
    /// Adds the heat that flows in through the walls to what `Diffuse` of the temperature gave.
    HeatWalls(Stage),
    /// No advection: the velocity after the forces begins the next step.
    KeepVelocity,

    /// Forgets the kick of the last step.
    ClearKick,
    /// Estimates the velocity in the middle of the kick, `u + kick - pressure kick`, then forgets the kick.
    EstimateMiddle,
    /// Adds `dt g` to the kick.
    Gravity,
    /// Adds `-dt beta (T - T0) g` to the kick.
    Buoyancy,
    /// Adds `dt nu lap u` to the kick.
    Viscosity(Stage),
    /// Adds the drag of a porous body to the kick.
    Drag,
    /// Solves for the velocity in the middle of the kick, viscosity taken there: `(V + dt nu K) u_m = V b`.
    ImplicitViscosity,
    /// Adds what viscosity did to the kick, `u_m - b`.
    ImplicitKick,
    /// `u_m + theta G`, of which the source is taken: with the mean pressure's kick as far as a short step would have it.
    PredictImplicit,
    /// Notes what divergence that has, and adds to the source what the rest of the mean pressure's kick stands for.
    AddMeanPressure,
    /// `u* = u + kick`.
    Predict,
    /// Source of the conservative pressure equation: the volume flux of `u*` out of every cell.
    Divergence,
    /// The same on scattered points, with `u*` fitted on every face.
    DivergenceByFit,
    /// Adds to it what the walls let through.
    AddWallFlux,
    /// Source of the collocated pressure equation: the fitted divergence inside, the normal velocity to be stopped at walls.
    CollocatedSource,
    /// The pressure matrix of points that move, summed up over cells, then over four of them at a time.
    Coarsen,
    /// Solves a symmetric equation: conjugate gradients, preconditioned by the diagonal and, where there is one, a coarse pressure.
    ConjugateGradient,
    /// Solves either equation: BiCGStab with the rank-one shift, preconditioned in the same way.
    Bicgstab,
    /// Solves either equation with a sparse factorisation made once, on the host.
    DirectSolve,
    /// `u = u* - (dt / rho) grad p` with the fitted gradient.
    CorrectByFit,
    /// The same with minus the adjoint of the divergence.
    CorrectByAdjoint,
    /// Gives the walls their velocity back.
    HoldWalls,
    /// Gives the points of slip sides and outlets the velocity of the fluid before them.
    OpenSides(Kicked),
    /// Goes on through the divergence-free velocity for the second half of the kick.
    Reflect,
    /// Moves the mean pressure towards the one found, and by `-rho nu` times that divergence.
    RelaxPressure,
    /// The kick of the mean pressure by the fitted gradient.
    MeanKickByFit,
    /// The same by minus the adjoint of the divergence.
    MeanKickByAdjoint,

    /// Points that move: moves the fluid's by `dt u*`.
    AdvancePoints,
    /// Forms and factorises the normal matrices, walls as mirrors; weak ones are lowered to a linear fit or to none.
    FactoriseMirrored,
    /// Fits the velocity under the forces alone, walls as mirrors of all of it but gravity's part.
    FitPredicted,
    /// Fits the velocity, walls as mirrors.
    FitMirrored,
    /// Adds `dt nu lap u` of these fits to the kick.
    FittedViscosity,
    /// Number density, and which points are the free surface.
    FindSurface,
    /// Rows and source of the pressure equation by fits, `p = 0` at the free surface; (2.6) and (3.2).
    AssembleMirrored,
    /// Rows and source of the pressure equation by weighted means, `p = 0` at the free surface; (2.4) and (3.1).
    AssembleDensity,
    /// `u = u* - (dt / rho) grad p` with the fitted gradient, walls as mirrors; the points follow.
    CorrectMirrored,
    /// The same with weighted means and the least pressure around each point (MPS).
    CorrectByLeast,
    /// The same with means that are right for linear pressures whatever neighbours a point has.
    CorrectByMoments,
    /// Shortens the way that the pressure moves a point where it is too long for one step, and the change of velocity with it.
    BoundPush,
    /// Moves points apart that are closer than others, and carries the fields there.
    ShiftPoints,
    /// Moves the fluid's points by what is left of their way.
    DisplacePoints,
    /// Points that have come too close and approach each other bounce.
    Collide,

    /// The weighted mean of a known field over neighbours, (2.2).
    Average,
    /// The gradient of a known field.
    Gradient,
    /// The Laplacian of a known field.
    Laplacian,
}

impl Operation {
    /// Name in snake case: of the WGSL file or folder, and as `plan` prints it.
    pub fn name(self) -> &'static str {
        match self {
            Operation::BuildCells(_) => "build_cells",
            Operation::FindNeighbours(_) => "find_neighbours",
            Operation::FindLocalNeighbours => "find_local_neighbours",
            Operation::Factorise(_) => "factorise",
            Operation::WidenSupport(_) => "widen_support",
            Operation::AssembleLaplacian => "assemble_laplacian",
            Operation::AssembleGradient => "assemble_gradient",
            Operation::AssembleIntegralLaplacian => "assemble_integral_laplacian",
            Operation::AssembleIntegralGradient => "assemble_integral_gradient",
            Operation::AssembleCollocated => "assemble_collocated",
            Operation::HoldOutlets => "hold_outlets",
            Operation::FitVelocity(_) => "fit_velocity",
            Operation::RemapDeparture => "remap_departure",
            Operation::MovePoints => "move_points",
            Operation::RemapForward => "remap_forward",
            Operation::FindDepartures => "find_departures",
            Operation::CarryVelocity => "carry_velocity",
            Operation::FitScalar(_) => "fit_scalar",
            Operation::CarryScalar(_) => "carry_scalar",
            Operation::Diffuse(..) => "diffuse",
            Operation::HeatWalls(_) => "heat_walls",
            Operation::KeepVelocity => "keep_velocity",
            Operation::ClearKick => "clear_kick",
            Operation::EstimateMiddle => "estimate_middle",
            Operation::Gravity => "gravity",
            Operation::Buoyancy => "buoyancy",
            Operation::Viscosity(_) => "viscosity",
            Operation::Drag => "drag",
            Operation::ImplicitViscosity => "implicit_viscosity",
            Operation::ImplicitKick => "implicit_kick",
            Operation::PredictImplicit => "predict_implicit",
            Operation::AddMeanPressure => "add_mean_pressure",
            Operation::Predict => "predict",
            Operation::Divergence => "divergence",
            Operation::DivergenceByFit => "divergence_by_fit",
            Operation::AddWallFlux => "add_wall_flux",
            Operation::CollocatedSource => "collocated_source",
            Operation::Coarsen => "coarsen",
            Operation::ConjugateGradient => "conjugate_gradient",
            Operation::Bicgstab => "bicgstab",
            Operation::DirectSolve => "direct_solve",
            Operation::CorrectByFit => "correct_by_fit",
            Operation::CorrectByAdjoint => "correct_by_adjoint",
            Operation::HoldWalls => "hold_walls",
            Operation::OpenSides(_) => "open_sides",
            Operation::Reflect => "reflect",
            Operation::RelaxPressure => "relax_pressure",
            Operation::MeanKickByFit => "mean_kick_by_fit",
            Operation::MeanKickByAdjoint => "mean_kick_by_adjoint",
            Operation::AdvancePoints => "advance_points",
            Operation::FactoriseMirrored => "factorise_mirrored",
            Operation::FitPredicted => "fit_predicted",
            Operation::FitMirrored => "fit_mirrored",
            Operation::FittedViscosity => "fitted_viscosity",
            Operation::FindSurface => "find_surface",
            Operation::AssembleMirrored => "assemble_mirrored",
            Operation::AssembleDensity => "assemble_density",
            Operation::CorrectMirrored => "correct_mirrored",
            Operation::BoundPush => "bound_push",
            Operation::CorrectByLeast => "correct_by_least",
            Operation::CorrectByMoments => "correct_by_moments",
            Operation::ShiftPoints => "shift_points",
            Operation::DisplacePoints => "displace_points",
            Operation::Collide => "collide",
            Operation::Average => "average",
            Operation::Gradient => "gradient",
            Operation::Laplacian => "laplacian",
        }
    }

    /// The equation that the operation solves, where it does.
    pub fn solves(self) -> Option<Equation> {
        match self {
            Operation::ConjugateGradient | Operation::Bicgstab | Operation::DirectSolve => Some(Equation::Pressure),
            Operation::ImplicitViscosity => Some(Equation::Viscosity),
            _ => None,
        }
    }

    /// Arrays that the operation reads and does not change.
    pub fn reads(self, plan: &super::Plan) -> Vec<Buffer> {
        use Buffer::*;
        let fits = |points| {
            vec![Position(points), Neighbours(points), NeighbourCount(points), Support(points), Factor(points)]
        };
        let with = |mut list: Vec<Buffer>, more: &[Buffer]| {
            list.extend_from_slice(more);
            list
        };
        let means = vec![
            Position(Points::Standing),
            Support(Points::Standing),
            Neighbours(Points::Standing),
            NeighbourCount(Points::Standing),
        ];
        let sums = |row| vec![Neighbours(Points::Standing), NeighbourCount(Points::Standing), row];
        let around = vec![Position(Points::Standing), Neighbours(Points::Standing), NeighbourCount(Points::Standing)];
        let sums_of_lists = vec![Neighbours(Points::Standing), NeighbourCount(Points::Standing)];
        let faces = [FaceNeighbours, FaceWeight, FaceCount];
        let standing = Points::Standing;
        match self {
            Operation::BuildCells(points) => vec![Position(points)],
            Operation::FindNeighbours(points) => vec![Position(points), CellStart(points), CellPoints(points)],
            Operation::FindLocalNeighbours => {
                vec![Position(standing), CellStart(standing), CellPoints(standing), Support(standing)]
            }
            Operation::Factorise(points) => {
                vec![Position(points), Neighbours(points), NeighbourCount(points), Support(points)]
            }
            Operation::WidenSupport(points) => vec![Position(points), CellStart(points), CellPoints(points)],
            Operation::AssembleLaplacian | Operation::AssembleGradient => fits(standing),
            Operation::AssembleIntegralLaplacian | Operation::AssembleIntegralGradient => means,
            Operation::AssembleCollocated => with(sums(LaplacianRow), &[GradientRow, Normal]),
            Operation::HoldOutlets => vec![Outlet],
            Operation::FitVelocity(points) => with(fits(points), &[plan.moving()]),
            Operation::RemapDeparture => {
                let [around, around_count] = plan.around();
                vec![Position(standing), around, around_count, Support(standing), plan.moving(), Coefficients]
            }
            Operation::FindDepartures => {
                let [around, around_count] = plan.around();
                let fits = [Position(standing), around, around_count, Support(standing), plan.moving(), Coefficients];
                with(fits.to_vec(), &[Normal])
            }
            Operation::CarryVelocity => {
                let departures = [Departure, DepartureNearest];
                with(departures.to_vec(), &[Position(standing), Support(standing), plan.moving(), Coefficients])
            }
            Operation::FitScalar(carried) => with(fits(standing), &[Carried(carried)]),
            Operation::CarryScalar(carried) => {
                let mut list = vec![Departure, DepartureNearest, Position(standing), Support(standing), ScalarFit];
                if carried == super::Carried::Temperature {
                    list.push(Reach(carried));
                }
                list
            }
            Operation::Diffuse(carried, stage) => {
                let mut list = with(faces.to_vec(), &[Reach(carried)]);
                list.push(if stage == Stage::Start { Carried(carried) } else { ScalarMiddle });
                list
            }
            Operation::HeatWalls(_) => vec![HeatSupply],
            Operation::MovePoints => vec![Position(standing), plan.moving()],
            Operation::RemapForward => {
                vec![Position(standing), Position(Points::Moved), Support(Points::Moved), plan.moving(), Coefficients]
            }
            Operation::KeepVelocity => vec![plan.moving()],
            Operation::ClearKick | Operation::Gravity => vec![],
            Operation::Buoyancy => vec![Carried(super::Carried::Temperature)],
            Operation::EstimateMiddle => vec![Velocity, PressureKick],
            Operation::Viscosity(stage) => with(sums(LaplacianRow), &[stage.velocity()]),
            Operation::Drag if plan.kick.contains(&Operation::Reflect) => vec![Velocity, Resistance, PressureKick],
            Operation::Drag => vec![Velocity, Resistance],
            Operation::ImplicitViscosity => with(faces.to_vec(), &[Diagonal, Volume, Projected]),
            Operation::ImplicitKick => vec![Middle, Projected],
            Operation::PredictImplicit => vec![Middle, PressureKick, Kick],
            Operation::AddMeanPressure => with(faces.to_vec(), &[MeanPressure, Volume]),
            Operation::Predict => vec![Velocity, Kick],
            Operation::Divergence => with(faces.to_vec(), &[Position(standing), Projected]),
            Operation::DivergenceByFit => vec![FluxPoints, FluxCount, FluxRow, Projected],
            // The source is there already: a sum, as the kick of a force is.
            Operation::AddWallFlux => vec![WallFlux],
            Operation::CollocatedSource => with(sums(GradientRow), &[Normal, RowScale, Velocity, Projected]),
            Operation::Coarsen => with(plan.matrix(), &[CellStart(standing), CellPoints(standing), Surface]),
            Operation::ConjugateGradient if plan.aggregates => {
                let parts = [CoarseCell, AggregateStart, AggregateParts, AggregateParent];
                let rows = [AggregateNeighbours, AggregateMatrix];
                with(with(with(plan.matrix(), &[Diagonal, Volume, Source]), &parts), &rows)
            }
            Operation::ConjugateGradient | Operation::Bicgstab if plan.coarsens() => {
                let coarse = [CellStart(standing), CellPoints(standing), CoarseCell, CoarseMatrix];
                with(with(plan.matrix(), &[Diagonal, Volume, Source]), &coarse)
            }
            Operation::ConjugateGradient | Operation::Bicgstab | Operation::DirectSolve => {
                with(plan.matrix(), &[Diagonal, Volume, Source])
            }
            Operation::CorrectByFit => with(sums(GradientRow), &[Pressure]),
            Operation::CorrectByAdjoint => with(faces.to_vec(), &[Position(standing), Volume, Pressure]),
            Operation::HoldWalls => vec![Velocity],
            Operation::OpenSides(_) => vec![OpenPoints, OpenRow, OpenCount, OpenNormal],
            Operation::Reflect => vec![Velocity, Projected, Kick],
            Operation::RelaxPressure => vec![Pressure, Dilation],
            Operation::MeanKickByFit => with(sums(GradientRow), &[MeanPressure]),
            Operation::MeanKickByAdjoint => with(faces.to_vec(), &[Position(standing), Volume, MeanPressure]),
            Operation::AdvancePoints => vec![],
            Operation::FindSurface => around,
            Operation::FactoriseMirrored => with(around, &[Surface]),
            Operation::FitPredicted | Operation::FitMirrored => with(around, &[Factor(standing), Projected]),
            Operation::FittedViscosity => vec![Coefficients],
            Operation::AssembleMirrored => with(around, &[Factor(standing), Crowding, Surface, Coefficients]),
            Operation::AssembleDensity => with(around, &[Crowding, Surface]),
            Operation::CorrectMirrored => with(around, &[Factor(standing), Surface]),
            Operation::CorrectByLeast | Operation::CorrectByMoments => around,
            Operation::ShiftPoints => with(around, &[Surface, Coefficients]),
            Operation::BoundPush => vec![],
            Operation::DisplacePoints => vec![Displacement],
            Operation::Collide => sums_of_lists,
            Operation::Average => with(means, &[Field]),
            Operation::Gradient => with(sums(GradientRow), &[Field]),
            Operation::Laplacian => with(sums(LaplacianRow), &[Field]),
        }
    }

    /// Arrays that the operation changes.
    pub fn writes(self) -> Vec<Buffer> {
        use Buffer::*;
        match self {
            Operation::BuildCells(points) => vec![CellStart(points), CellPoints(points)],
            Operation::FindNeighbours(points) => vec![Neighbours(points), NeighbourCount(points), Support(points)],
            Operation::FindLocalNeighbours => vec![Neighbours(Points::Standing), NeighbourCount(Points::Standing)],
            Operation::Factorise(points) => vec![Factor(points), Rung(points)],
            Operation::WidenSupport(points) => {
                vec![Support(points), Neighbours(points), NeighbourCount(points), Factor(points), Rung(points)]
            }
            Operation::AssembleLaplacian | Operation::AssembleIntegralLaplacian => vec![LaplacianRow],
            Operation::AssembleGradient | Operation::AssembleIntegralGradient => vec![GradientRow],
            Operation::AssembleCollocated | Operation::HoldOutlets => vec![MatrixRow, RowScale, Diagonal],
            Operation::FitVelocity(_) => vec![Coefficients],
            Operation::RemapDeparture
            | Operation::RemapForward
            | Operation::CarryVelocity
            | Operation::KeepVelocity => vec![Velocity],
            Operation::FindDepartures => vec![Departure, DepartureNearest],
            Operation::FitScalar(_) => vec![ScalarFit],
            Operation::CarryScalar(carried) | Operation::Diffuse(carried, Stage::Middle) => vec![Carried(carried)],
            Operation::Diffuse(_, Stage::Start) | Operation::HeatWalls(Stage::Start) => vec![ScalarMiddle],
            Operation::HeatWalls(Stage::Middle) => vec![Carried(super::Carried::Temperature)],
            Operation::MovePoints => vec![Position(Points::Moved)],
            Operation::ClearKick
            | Operation::Gravity
            | Operation::Buoyancy
            | Operation::Viscosity(_)
            | Operation::Drag => vec![Kick],
            Operation::ImplicitViscosity => vec![Middle, ViscousResidual, ViscousDirection, ViscousProduct],
            Operation::ImplicitKick => vec![Kick],
            Operation::RelaxPressure => vec![MeanPressure],
            Operation::MeanKickByFit | Operation::MeanKickByAdjoint => vec![PressureKick],
            Operation::EstimateMiddle => vec![Projected, Kick],
            Operation::Predict
            | Operation::PredictImplicit
            | Operation::CorrectByFit
            | Operation::CorrectByAdjoint
            | Operation::HoldWalls => vec![Projected],
            Operation::Divergence
            | Operation::DivergenceByFit
            | Operation::AddWallFlux
            | Operation::CollocatedSource => vec![Source],
            Operation::AddMeanPressure => vec![Source, Dilation],
            Operation::ConjugateGradient => vec![Pressure, Residual, Direction, Product],
            Operation::Bicgstab => {
                vec![Pressure, Residual, Direction, Product, Shadow, Stabilised, StabilisedProduct, Preconditioned]
            }
            Operation::DirectSolve => vec![Pressure],
            Operation::OpenSides(kicked) => vec![kicked.velocity()],
            Operation::Reflect => vec![PressureKick, Reflected],
            Operation::AdvancePoints => vec![Position(Points::Standing), Projected],
            Operation::FactoriseMirrored => vec![Factor(Points::Standing), Rung(Points::Standing)],
            Operation::FitPredicted | Operation::FitMirrored => vec![Coefficients],
            Operation::FittedViscosity => vec![Kick],
            Operation::FindSurface => vec![Crowding, Surface],
            Operation::AssembleMirrored | Operation::AssembleDensity => vec![MatrixRow, Diagonal, Source, Pressure],
            Operation::Coarsen => vec![CoarseCell, CoarseMatrix],
            Operation::BoundPush => vec![Projected, Displacement, Bounded],
            Operation::ShiftPoints => vec![Projected, Displacement],
            Operation::CorrectMirrored | Operation::CorrectByLeast | Operation::CorrectByMoments => {
                vec![Pressure, Projected, Displacement]
            }
            Operation::DisplacePoints => vec![Position(Points::Standing), Projected],
            Operation::Collide => vec![Position(Points::Standing), Projected, Kick],
            Operation::Average => vec![FieldAverage],
            Operation::Gradient => vec![FieldGradient],
            Operation::Laplacian => vec![FieldLaplacian],
        }
    }

    /// Arrays among them that it writes whole, whatever they held: what they held before need not be kept. Of an operation
    /// that is not named here, every array is taken to matter.
    pub fn fills(self) -> Vec<Buffer> {
        use Buffer::*;
        match self {
            Operation::BuildCells(_)
            | Operation::FindNeighbours(_)
            | Operation::Factorise(_)
            | Operation::AssembleLaplacian
            | Operation::AssembleGradient
            | Operation::AssembleIntegralLaplacian
            | Operation::AssembleIntegralGradient
            | Operation::AssembleCollocated
            | Operation::FitVelocity(_)
            | Operation::FindDepartures
            | Operation::FitScalar(_)
            | Operation::Diffuse(_, Stage::Start)
            | Operation::MovePoints
            | Operation::KeepVelocity
            | Operation::ClearKick
            | Operation::Predict
            | Operation::Divergence
            | Operation::DivergenceByFit
            | Operation::CollocatedSource
            | Operation::FindSurface
            | Operation::FactoriseMirrored
            | Operation::FitPredicted
            | Operation::FitMirrored
            | Operation::Coarsen
            | Operation::DirectSolve => self.writes(),
            Operation::AssembleMirrored | Operation::AssembleDensity => vec![MatrixRow, Diagonal, Source],
            Operation::CorrectMirrored | Operation::CorrectByLeast | Operation::CorrectByMoments => vec![Displacement],
            Operation::Collide => vec![Kick],
            Operation::EstimateMiddle => vec![Projected],
            Operation::ImplicitViscosity => vec![ViscousResidual, ViscousDirection, ViscousProduct],
            Operation::AddMeanPressure => vec![Dilation],
            Operation::PredictImplicit | Operation::MeanKickByFit | Operation::MeanKickByAdjoint => self.writes(),
            // The solution begins from the one at hand.
            Operation::ConjugateGradient | Operation::Bicgstab => {
                self.writes().into_iter().filter(|&buffer| buffer != Pressure).collect()
            }
            Operation::Reflect => vec![Reflected],
            _ => vec![],
        }
    }
}
