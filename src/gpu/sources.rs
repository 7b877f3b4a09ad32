//! The WGSL files: which stages an operation has, and what `#import` brings in.

use super::layout::Extent;
use super::{grids, unrolled};
use crate::case::{PressureForm, Weight};
use crate::engine::EngineError;
use crate::scene::Scene;
use crate::step::{Carried, Equation, Operation, Plan, Stage as Part};

/// One kernel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    /// Path below `shaders/`, without the ending.
    pub name: &'static str,
    pub source: &'static str,
    /// Where its number of workgroups stands; `None` for a single workgroup.
    pub extent: Option<Extent>,
}

/// What runs for one operation.
#[derive(Debug, Clone)]
pub(super) enum Stages {
    /// Once, in order.
    Once(Vec<Stage>),
    /// A solve: `check` and `iterate` until a residual is low enough.
    Solve { check: Vec<Stage>, iterate: Vec<Stage> },
}

#[cfg(test)]
impl Stages {
    pub fn all(&self) -> impl Iterator<Item = Stage> + '_ {
        let (first, second): (&[Stage], &[Stage]) = match self {
            Stages::Once(stages) => (stages, &[]),
            Stages::Solve { check, iterate } => (check, iterate),
        };
        first.iter().chain(second).copied()
    }
}

macro_rules! stage {
    ($name:literal) => {
        Stage { name: $name, source: include_str!(concat!("../../shaders/", $name, ".wgsl")), extent: None }
    };
    ($name:literal, $extent:ident) => {
        Stage { extent: Some(Extent::$extent), ..stage!($name) }
    };
}

pub(super) const BEGIN_SOLVE: Stage = stage!("step/begin_solve");
pub(super) const BEGIN_VISCOUS_SOLVE: Stage = stage!("step/begin_viscous_solve");
pub(super) const END_SOLVE: Stage = stage!("step/end_solve");
pub(super) const WATCH_VELOCITY: Stage = stage!("step/watch_velocity", Points);
pub(super) const WATCH_PRESSURE: Stage = stage!("step/watch_pressure", Points);
pub(super) const WATCH_CARRIED: Stage = stage!("step/watch_carried", Points);
pub(super) const END_STEP: Stage = stage!("step/end_step");
pub(super) const MEASURE: [Stage; 2] = [stage!("measure/partial", Points), stage!("measure/total")];

/// What a solve of an equation begins with.
pub(super) fn begin(equation: Equation) -> Stage {
    match equation {
        Equation::Pressure => BEGIN_SOLVE,
        Equation::Viscosity => BEGIN_VISCOUS_SOLVE,
    }
}

/// The kernels of an operation.
pub(super) fn stages(operation: Operation, plan: &Plan) -> Stages {
    let once = |stage: Stage| Stages::Once(vec![stage]);
    match operation {
        Operation::BuildCells(_) => Stages::Once(vec![
            stage!("build_cells/clear", Cells),
            stage!("build_cells/count", Points),
            stage!("build_cells/sum_tiles", Cells),
            stage!("build_cells/scan_tiles"),
            stage!("build_cells/starts", Cells),
            stage!("build_cells/scatter", Points),
            stage!("build_cells/sort", Cells),
        ]),
        Operation::FindNeighbours(_) => once(stage!("find_neighbours", Points)),
        Operation::FindLocalNeighbours => once(stage!("find_local_neighbours", Points)),
        Operation::Factorise(_) => once(stage!("factorise", Points)),
        Operation::WidenSupport(_) => once(stage!("widen_support", Points)),
        Operation::AssembleLaplacian => once(stage!("assemble_laplacian", Points)),
        Operation::AssembleGradient => once(stage!("assemble_gradient", Points)),
        Operation::AssembleIntegralLaplacian => once(stage!("assemble_integral_laplacian", Points)),
        Operation::AssembleIntegralGradient => once(stage!("assemble_integral_gradient", Points)),
        Operation::AssembleCollocated => once(stage!("assemble_collocated", Points)),
        Operation::HoldOutlets => once(stage!("hold_outlets", Points)),
        Operation::FitVelocity(_) => once(stage!("fit_velocity", Points)),
        Operation::RemapDeparture => once(stage!("remap_departure", Points)),
        Operation::MovePoints => once(stage!("move_points", Points)),
        Operation::RemapForward => once(stage!("remap_forward", Points)),
        Operation::FindDepartures => once(stage!("find_departures", Points)),
        Operation::CarryVelocity => once(stage!("carry_velocity", Points)),
        Operation::FitScalar(_) => once(stage!("fit_scalar", Points)),
        Operation::CarryScalar(Carried::Temperature) => once(stage!("carry_scalar/free", Points)),
        Operation::CarryScalar(Carried::Tracer(_)) => once(stage!("carry_scalar/all", Points)),
        Operation::Diffuse(_, Part::Start) => once(stage!("diffuse/start", Points)),
        Operation::Diffuse(_, Part::Middle) => once(stage!("diffuse/middle", Points)),
        Operation::HeatWalls(Part::Start) => once(stage!("heat_walls/start", Points)),
        Operation::HeatWalls(Part::Middle) => once(stage!("heat_walls/middle", Points)),
        Operation::KeepVelocity => once(stage!("keep_velocity", Points)),
        Operation::Average => once(stage!("average", Points)),
        Operation::Gradient => once(stage!("gradient", Points)),
        Operation::Laplacian => once(stage!("laplacian", Points)),
        Operation::ClearKick => once(stage!("clear_kick", Points)),
        Operation::Gravity => once(stage!("gravity", Points)),
        Operation::Buoyancy => once(stage!("buoyancy", Points)),
        Operation::EstimateMiddle => once(stage!("estimate_middle", Points)),
        Operation::Viscosity(_) => once(stage!("viscosity", Points)),
        Operation::Drag => once(stage!("drag", Points)),
        Operation::ImplicitViscosity => Stages::Solve {
            check: vec![stage!("implicit_viscosity/residual", Check), stage!("implicit_viscosity/judge")],
            iterate: vec![
                stage!("implicit_viscosity/product", Iterate),
                stage!("implicit_viscosity/alpha"),
                stage!("implicit_viscosity/update", Iterate),
                stage!("implicit_viscosity/beta"),
                stage!("implicit_viscosity/direction", Iterate),
            ],
        },
        Operation::ImplicitKick => once(stage!("implicit_kick", Points)),
        Operation::PredictImplicit => once(stage!("predict_implicit", Points)),
        Operation::AddMeanPressure => once(stage!("add_mean_pressure", Points)),
        Operation::RelaxPressure => once(stage!("relax_pressure", Points)),
        Operation::MeanKickByFit => once(stage!("mean_kick_by_fit", Points)),
        Operation::MeanKickByAdjoint => once(stage!("mean_kick_by_adjoint", Points)),
        Operation::Predict => once(stage!("predict", Points)),
        Operation::Divergence => once(stage!("divergence", Points)),
        Operation::DivergenceByFit => once(stage!("divergence_by_fit", Points)),
        Operation::AddWallFlux => once(stage!("add_wall_flux", Points)),
        Operation::CollocatedSource => once(stage!("collocated_source", Points)),
        Operation::ConjugateGradient => conjugate_gradient(plan.coarsens()),
        Operation::Bicgstab => bicgstab(plan.coarsens()),
        Operation::Coarsen => Stages::Once(vec![
            stage!("coarsen/place", Cells),
            stage!("coarsen/finest", Cells),
            stage!("coarsen/coarser"),
        ]),
        Operation::DirectSolve => once(stage!("direct_solve")),
        Operation::CorrectByFit => once(stage!("correct_by_fit", Points)),
        Operation::CorrectByAdjoint => once(stage!("correct_by_adjoint", Points)),
        Operation::HoldWalls => once(stage!("hold_walls", Points)),
        Operation::OpenSides(_) => once(stage!("open_sides", Points)),
        Operation::Reflect => once(stage!("reflect", Points)),
        Operation::AdvancePoints => once(stage!("advance_points", Points)),
        Operation::FactoriseMirrored => once(stage!("factorise_mirrored", Points)),
        Operation::FitPredicted => once(stage!("fit_predicted", Points)),
        Operation::FitMirrored => once(stage!("fit_mirrored", Points)),
        Operation::FittedViscosity => once(stage!("fitted_viscosity", Points)),
        Operation::FindSurface => once(stage!("find_surface", Points)),
        Operation::AssembleMirrored => once(stage!("assemble_mirrored", Points)),
        Operation::AssembleDensity => once(stage!("assemble_density", Points)),
        Operation::CorrectMirrored => {
            Stages::Once(vec![stage!("correct_mirrored/clamp", Points), stage!("correct_mirrored/gradient", Points)])
        }
        Operation::BoundPush => once(stage!("bound_push", Points)),
        Operation::CorrectByLeast => {
            Stages::Once(vec![stage!("correct_by_least/clamp", Points), stage!("correct_by_least/gradient", Points)])
        }
        Operation::CorrectByMoments => Stages::Once(vec![
            stage!("correct_by_moments/clamp", Points),
            stage!("correct_by_moments/gradient", Points),
        ]),
        Operation::ShiftPoints => once(stage!("shift_points", Points)),
        Operation::DisplacePoints => once(stage!("displace_points", Points)),
        Operation::Collide => Stages::Once(vec![stage!("collide/impulses", Points), stage!("collide/bounce", Points)]),
    }
}

fn conjugate_gradient(coarsens: bool) -> Stages {
    let mut check = vec![
        stage!("conjugate_gradient/residual", Check),
        stage!("conjugate_gradient/mean"),
        stage!("conjugate_gradient/start", Check),
    ];
    let mut iterate = vec![
        stage!("conjugate_gradient/product", Iterate),
        stage!("conjugate_gradient/alpha"),
        stage!("conjugate_gradient/update", Iterate),
    ];
    if coarsens {
        check.extend([
            stage!("conjugate_gradient/restrict", CheckCells),
            stage!("conjugate_gradient/down", CheckFours),
            stage!("conjugate_gradient/coarser", CheckOnce),
            stage!("conjugate_gradient/up", CheckCells),
            stage!("conjugate_gradient/add_coarse", Check),
        ]);
        iterate.extend([
            stage!("conjugate_gradient/restrict", IterateCells),
            stage!("conjugate_gradient/down", IterateFours),
            stage!("conjugate_gradient/coarser", IterateOnce),
            stage!("conjugate_gradient/up", IterateCells),
        ]);
    }
    check.push(stage!("conjugate_gradient/judge"));
    iterate.extend([stage!("conjugate_gradient/beta"), stage!("conjugate_gradient/direction", Iterate)]);
    Stages::Solve { check, iterate }
}

/// With a coarse pressure there is no rank-one shift: the pressure is held somewhere.
fn bicgstab(coarsens: bool) -> Stages {
    let check = vec![
        stage!("bicgstab/pressure_sum", Check),
        stage!("bicgstab/check_shift"),
        stage!("bicgstab/residual", Check),
        stage!("bicgstab/judge"),
    ];
    let shift = stage!("bicgstab/shift");
    let cycle = [
        stage!("bicgstab/down", IterateFours),
        stage!("bicgstab/coarser", IterateOnce),
        stage!("bicgstab/up", IterateCells),
    ];
    let mut iterate = Vec::new();
    if coarsens {
        iterate.push(stage!("bicgstab/restrict_direction", IterateCells));
        iterate.extend(cycle);
    }
    iterate.push(stage!("bicgstab/precondition_direction", Iterate));
    if !coarsens {
        iterate.push(shift);
    }
    iterate.extend([
        stage!("bicgstab/product", Iterate),
        stage!("bicgstab/alpha"),
        stage!("bicgstab/stabilise", Iterate),
    ]);
    if coarsens {
        iterate.push(stage!("bicgstab/restrict_stabilised", IterateCells));
        iterate.extend(cycle);
        iterate.push(stage!("bicgstab/add_coarse", Iterate));
    } else {
        iterate.push(shift);
    }
    iterate.extend([
        stage!("bicgstab/stabilised_product", Iterate),
        stage!("bicgstab/omega"),
        stage!("bicgstab/update", Iterate),
        stage!("bicgstab/beta"),
        stage!("bicgstab/direction", Iterate),
    ]);
    Stages::Solve { check, iterate }
}

/// The text behind `#import name`; a choice of the case picks among files of one meaning.
fn library(name: &str, scene: &Scene) -> Option<&'static str> {
    macro_rules! text {
        ($name:literal) => {
            include_str!(concat!("../../shaders/library/", $name, ".wgsl"))
        };
    }
    let conservative = scene.plan.form == Some(PressureForm::Conservative);
    let integral = scene.plan.form == Some(PressureForm::Integral);
    let aggregates = scene.plan.aggregates;
    Some(match name {
        "points" => text!("points"),
        "cells" => text!("cells"),
        "conjugate_gradient_alpha" => text!("conjugate_gradient/alpha"),
        "conjugate_gradient_beta" => text!("conjugate_gradient/beta"),
        "conjugate_gradient_judge" => text!("conjugate_gradient/judge"),
        "clamp" => text!("clamp"),
        "coarse_store" => text!("coarse/store"),
        "coarse_cycle" if aggregates => text!("aggregates/cycle"),
        "coarse_cycle" => text!("coarse/cycle"),
        "coarse_restrict" if aggregates => text!("aggregates/restrict"),
        "coarse_restrict" => text!("coarse/restrict"),
        "coarse_down" => text!("coarse/down"),
        "coarse_coarser" => text!("coarse/coarser"),
        "coarse_up" if aggregates => text!("aggregates/up"),
        "coarse_up" => text!("coarse/up"),
        "coarse_at" if scene.plan.coarsens() => text!("coarse/at_points"),
        "coarse_at" => text!("coarse/absent"),
        "search" => text!("search"),
        "normal_matrix" => text!("normal_matrix"),
        "normal_equations" => text!("normal_equations"),
        "fit" => text!("fit"),
        "fit_rows" => text!("fit_rows"),
        "mean" => text!("mean"),
        "least" => text!("least"),
        "mirror" => text!("mirror"),
        "mirrored_fit" => text!("mirrored_fit"),
        "stored_coefficient" => text!("stored_coefficient"),
        "tank" => text!("tank"),
        "crowding" if integral => text!("crowding/mean"),
        "crowding" => text!("crowding/fitted"),
        "gradient" => text!("gradient"),
        "fitted_gradient" => text!("fitted_gradient"),
        "adjoint_gradient" => text!("adjoint_gradient"),
        "fitted_flux" => text!("fitted_flux"),
        "evaluate" => text!("evaluate"),
        "departure" => text!("departure"),
        "nearest" => text!("nearest"),
        "brought" => text!("brought"),
        "exchange" => text!("exchange"),
        "face_flux" => text!("face_flux"),
        "shift_of" => text!("shift_of"),
        "sums" => text!("sums"),
        "total" => text!("total"),
        "finite" => text!("finite"),
        "control" => text!("control"),
        "monitor" => text!("monitor"),
        "weight" => match scene.constants.weight {
            Weight::None => text!("weight/none"),
            Weight::Quadratic => text!("weight/quadratic"),
            Weight::Smooth => text!("weight/smooth"),
        },
        "space" if scene.constants.grid.periodic == [false; 2] => text!("space/walled"),
        "space" => text!("space/periodic"),
        "wall_flux_of" if scene.plan.through_flow => text!("wall_flux/prescribed"),
        "wall_flux_of" => text!("wall_flux/none"),
        "matrix" if conservative => text!("matrix/conservative"),
        "matrix" if integral => text!("matrix/symmetric"),
        "matrix" => text!("matrix/collocated"),
        "mean_kick_of" if scene.plan.kick.contains(&Operation::Reflect) => text!("mean_kick/kept"),
        "mean_kick_of" => text!("mean_kick/none"),
        "viscous_matrix" => text!("viscous_matrix"),
        "viscous_diagonal" => text!("viscous_diagonal"),
        "density" if conservative => text!("density/conservative"),
        "density" if integral => text!("density/symmetric"),
        "density" => text!("density/collocated"),
        "divergence_of" if scene.fluxes().is_some() => text!("divergence/fitted_faces"),
        "divergence_of" if conservative => text!("divergence/conservative"),
        "divergence_of" if integral => text!("divergence/mean"),
        "divergence_of" if scene.plan.moves() => text!("divergence/mirrored"),
        "divergence_of" => text!("divergence/fitted"),
        _ => return None,
    })
}

/// The stage's text with its imports in place, each once.
pub(super) fn expand(stage: &Stage, scene: &Scene) -> Result<String, EngineError> {
    let mut text = String::new();
    let mut seen = Vec::new();
    append(stage.source, scene, &mut seen, &mut text)
        .map_err(|name| EngineError::Device(format!("{}.wgsl: no library file is called {name:?}", stage.name)))?;
    Ok(text)
}

fn append(source: &str, scene: &Scene, seen: &mut Vec<String>, text: &mut String) -> Result<(), String> {
    for line in source.lines() {
        match line.strip_prefix("#import ") {
            Some(name) if seen.iter().any(|other| other == name) => {}
            Some(name) => {
                seen.push(name.to_owned());
                let written = unrolled::library(name, scene.constants.order).or_else(|| grids::library(name, scene));
                match written {
                    Some(written) => text.push_str(&written),
                    None => append(library(name, scene).ok_or(name)?, scene, seen, text)?,
                }
            }
            None => {
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    Ok(())
}
