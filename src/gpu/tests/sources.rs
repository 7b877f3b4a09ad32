//! Every kernel of every operation parses and validates, in both precisions.

use std::collections::BTreeSet;

use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

use super::{
    CHANGES, Precision, channel_scene, collocated_channel_scene, forceless_scene, graded_scene, heated_scene,
    moving_scenes, open_scene, periodic_scene, scene, still_scene,
};
use crate::gpu::bindings::arrays_of;
use crate::gpu::launch::assemble;
use crate::gpu::layout::{Scalar, Time, Word};
use crate::gpu::prelude::prelude;
use crate::gpu::program::{end_step_stages, measured_arrays};
use crate::gpu::sources::{self, Stages};
use crate::scene::Scene;
use crate::step::{Carried, Kicked, Operation, Points, Stage};

/// Functions whose f64 versions pass validation and return garbage on some drivers.
const NOT_IN_F64: [&str; 12] =
    ["exp", "exp2", "log", "log2", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "pow"];

fn scenes() -> Vec<Scene> {
    let (flows, lies) =
        ([heated_scene(), channel_scene(), collocated_channel_scene()], [periodic_scene(), graded_scene()]);
    let others = [still_scene(), forceless_scene(), open_scene()].into_iter().chain(flows).chain(lies);
    CHANGES.iter().map(|changes| scene(changes)).chain(others).chain(moving_scenes()).collect()
}

/// Every kernel of a scene, by name, as the driver gets it.
fn kernels(scene: &Scene, precision: Precision) -> Vec<(&'static str, String)> {
    let prelude = prelude(scene, precision);
    let mut found = Vec::new();
    let mut add = |stage: &sources::Stage, arrays: &_| {
        let (text, _) = assemble(stage, scene, &prelude, arrays).expect(stage.name);
        found.push((stage.name, text));
    };
    for operation in scene.plan.operations() {
        let arrays = arrays_of(operation, scene);
        let stages = sources::stages(operation, &scene.plan);
        stages.all().for_each(|stage| add(&stage, &arrays));
        if matches!(stages, Stages::Solve { .. }) {
            let equation = operation.solves().expect("a solve");
            [sources::begin(equation), sources::END_SOLVE].iter().for_each(|stage| add(stage, &arrays));
        }
    }
    for (stage, arrays) in end_step_stages(scene) {
        add(&stage, &arrays);
    }
    sources::MEASURE.iter().for_each(|stage| add(stage, &measured_arrays(scene)));
    found
}

#[test]
fn every_kernel_validates_in_both_precisions() {
    for scene in scenes() {
        for precision in [Precision::Single, Precision::Double] {
            for (name, text) in kernels(&scene, precision) {
                let module =
                    wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&text)));
                let mut validator = Validator::new(ValidationFlags::all(), Capabilities::FLOAT64);
                validator.validate(&module).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&text)));
            }
        }
    }
}

/// WebGPU promises 8 arrays a kernel; every desktop adapter has many more, and phones 16.
#[test]
fn no_kernel_binds_more_arrays_than_adapters_have() {
    for scene in scenes() {
        for (name, text) in kernels(&scene, Precision::Single) {
            assert!(text.matches("@binding(").count() <= 12, "{name}");
        }
    }
}

#[test]
fn the_scenes_of_the_tests_use_every_operation() {
    let used: BTreeSet<Operation> =
        scenes().iter().flat_map(|scene| scene.plan.operations().collect::<Vec<_>>()).collect();
    let both = |operation: fn(Points) -> Operation| [operation(Points::Standing), operation(Points::Moved)];
    let mut all: BTreeSet<Operation> = [
        Operation::FindLocalNeighbours,
        Operation::AssembleLaplacian,
        Operation::AssembleGradient,
        Operation::AssembleCollocated,
        Operation::HoldOutlets,
        Operation::RemapDeparture,
        Operation::MovePoints,
        Operation::RemapForward,
        Operation::KeepVelocity,
        Operation::ClearKick,
        Operation::Gravity,
        Operation::OpenSides(Kicked::Before),
        Operation::OpenSides(Kicked::Within),
        Operation::OpenSides(Kicked::After),
        Operation::Buoyancy,
        Operation::FindDepartures,
        Operation::CarryVelocity,
        Operation::HeatWalls(Stage::Start),
        Operation::HeatWalls(Stage::Middle),
        Operation::EstimateMiddle,
        Operation::Drag,
        Operation::ImplicitViscosity,
        Operation::ImplicitKick,
        Operation::PredictImplicit,
        Operation::AddMeanPressure,
        Operation::RelaxPressure,
        Operation::MeanKickByFit,
        Operation::MeanKickByAdjoint,
        Operation::Viscosity(Stage::Start),
        Operation::Viscosity(Stage::Middle),
        Operation::Predict,
        Operation::Divergence,
        Operation::DivergenceByFit,
        Operation::AddWallFlux,
        Operation::CollocatedSource,
        Operation::Coarsen,
        Operation::ConjugateGradient,
        Operation::Bicgstab,
        Operation::DirectSolve,
        Operation::CorrectByFit,
        Operation::CorrectByAdjoint,
        Operation::HoldWalls,
        Operation::Reflect,
        Operation::AdvancePoints,
        Operation::FactoriseMirrored,
        Operation::FitPredicted,
        Operation::FitMirrored,
        Operation::FittedViscosity,
        Operation::FindSurface,
        Operation::AssembleMirrored,
        Operation::AssembleDensity,
        Operation::CorrectMirrored,
        Operation::BoundPush,
        Operation::CorrectByLeast,
        Operation::CorrectByMoments,
        Operation::ShiftPoints,
        Operation::DisplacePoints,
        Operation::Collide,
        Operation::AssembleIntegralLaplacian,
    ]
    .into();
    for operation in [
        Operation::BuildCells,
        Operation::FindNeighbours,
        Operation::Factorise,
        Operation::WidenSupport,
        Operation::FitVelocity,
    ] {
        all.extend(both(operation));
    }
    for field in [Carried::Temperature, Carried::Tracer(0)] {
        all.extend([Operation::FitScalar(field), Operation::CarryScalar(field)]);
        all.extend([Stage::Start, Stage::Middle].map(|stage| Operation::Diffuse(field, stage)));
    }
    assert_eq!(used, all);
}

/// Kernels and host find them there.
#[test]
fn what_is_kept_of_the_viscous_solve_stands_behind_the_same_of_the_pressures() {
    let mut found = 0;
    for names in [Word::NAMES, Scalar::NAMES, Time::NAMES] {
        for (before, name) in names.iter().zip(&names[1..]).filter(|(_, name)| name.contains("VISCOUS_")) {
            assert_eq!(**before, name.replace("VISCOUS_", ""));
            found += 1;
        }
    }
    assert_eq!(found, 8);
}

#[test]
fn the_kernels_of_an_operation_carry_its_name() {
    for scene in scenes() {
        for operation in scene.plan.operations() {
            for stage in sources::stages(operation, &scene.plan).all() {
                let folder = stage.name.split('/').next();
                assert_eq!(folder, Some(operation.name()), "{}", stage.name);
            }
        }
    }
}

#[test]
fn what_an_operation_writes_is_written_by_its_kernels() {
    for scene in scenes() {
        for operation in scene.plan.operations().filter(|&operation| operation != Operation::DirectSolve) {
            let arrays = arrays_of(operation, &scene);
            let text: String = sources::stages(operation, &scene.plan)
                .all()
                .map(|stage| sources::expand(&stage, &scene).expect(stage.name))
                .collect();
            for (_, name) in &arrays[1] {
                assert!(text.contains(&format!("{name}[")), "{operation:?} never touches {name}");
            }
        }
    }
}

#[test]
fn no_kernel_calls_a_function_that_lacks_f64() {
    for scene in scenes() {
        for (name, text) in kernels(&scene, Precision::Double) {
            for function in NOT_IN_F64 {
                let calls = text
                    .match_indices(&format!("{function}("))
                    .any(|(at, _)| !text[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_'));
                assert!(!calls, "{name} calls {function}");
            }
        }
    }
}
