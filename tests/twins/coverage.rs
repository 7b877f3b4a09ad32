//! Every operation there is has a scene, a shader and a CPU function of its name.

use std::collections::BTreeSet;
use std::path::Path;

use stillpoint::step::{Carried, Kicked, Operation, Points, Stage};

use crate::scenes;

/// Every operation. A new one does not compile here until it stands in the list that `next` walks.
pub fn all() -> Vec<Operation> {
    std::iter::successors(Some(Operation::BuildCells(Points::Standing)), |&operation| next(operation)).collect()
}

fn next(operation: Operation) -> Option<Operation> {
    use Carried::{Temperature, Tracer};
    use Operation::*;
    use Points::{Moved, Standing};
    Some(match operation {
        BuildCells(Standing) => BuildCells(Moved),
        BuildCells(Moved) => FindNeighbours(Standing),
        FindNeighbours(Standing) => FindNeighbours(Moved),
        FindNeighbours(Moved) => FindLocalNeighbours,
        FindLocalNeighbours => Factorise(Standing),
        Factorise(Standing) => Factorise(Moved),
        Factorise(Moved) => WidenSupport(Standing),
        WidenSupport(Standing) => WidenSupport(Moved),
        WidenSupport(Moved) => AssembleLaplacian,
        AssembleLaplacian => AssembleGradient,
        AssembleGradient => AssembleIntegralLaplacian,
        AssembleIntegralLaplacian => AssembleIntegralGradient,
        AssembleIntegralGradient => AssembleCollocated,
        AssembleCollocated => HoldOutlets,
        HoldOutlets => FitVelocity(Standing),
        FitVelocity(Standing) => FitVelocity(Moved),
        FitVelocity(Moved) => RemapDeparture,
        RemapDeparture => MovePoints,
        MovePoints => RemapForward,
        RemapForward => FindDepartures,
        FindDepartures => CarryVelocity,
        CarryVelocity => FitScalar(Temperature),
        FitScalar(Temperature) => FitScalar(Tracer(0)),
        FitScalar(Tracer(0)) => FitScalar(Tracer(1)),
        // More of them are done alike.
        FitScalar(Tracer(_)) => CarryScalar(Temperature),
        CarryScalar(Temperature) => CarryScalar(Tracer(0)),
        CarryScalar(Tracer(0)) => CarryScalar(Tracer(1)),
        CarryScalar(Tracer(_)) => Diffuse(Temperature, Stage::Start),
        Diffuse(Temperature, Stage::Start) => Diffuse(Temperature, Stage::Middle),
        Diffuse(Temperature, Stage::Middle) => Diffuse(Tracer(0), Stage::Start),
        Diffuse(Tracer(_), Stage::Start) => Diffuse(Tracer(0), Stage::Middle),
        Diffuse(Tracer(_), Stage::Middle) => HeatWalls(Stage::Start),
        HeatWalls(Stage::Start) => HeatWalls(Stage::Middle),
        HeatWalls(Stage::Middle) => KeepVelocity,
        KeepVelocity => ClearKick,
        ClearKick => Gravity,
        Gravity => Buoyancy,
        Buoyancy => EstimateMiddle,
        EstimateMiddle => Drag,
        Drag => ImplicitViscosity,
        ImplicitViscosity => ImplicitKick,
        ImplicitKick => PredictImplicit,
        PredictImplicit => AddMeanPressure,
        AddMeanPressure => RelaxPressure,
        RelaxPressure => MeanKickByFit,
        MeanKickByFit => MeanKickByAdjoint,
        MeanKickByAdjoint => Viscosity(Stage::Start),
        Viscosity(Stage::Start) => Viscosity(Stage::Middle),
        Viscosity(Stage::Middle) => Predict,
        Predict => Divergence,
        Divergence => DivergenceByFit,
        DivergenceByFit => AddWallFlux,
        AddWallFlux => CollocatedSource,
        CollocatedSource => Coarsen,
        Coarsen => ConjugateGradient,
        ConjugateGradient => Bicgstab,
        Bicgstab => DirectSolve,
        DirectSolve => CorrectByFit,
        CorrectByFit => CorrectByAdjoint,
        CorrectByAdjoint => HoldWalls,
        HoldWalls => OpenSides(Kicked::Before),
        OpenSides(Kicked::Before) => OpenSides(Kicked::Within),
        OpenSides(Kicked::Within) => OpenSides(Kicked::After),
        OpenSides(Kicked::After) => Reflect,
        Reflect => AdvancePoints,
        AdvancePoints => FactoriseMirrored,
        FactoriseMirrored => FitPredicted,
        FitPredicted => FitMirrored,
        FitMirrored => FittedViscosity,
        FittedViscosity => FindSurface,
        FindSurface => AssembleMirrored,
        AssembleMirrored => AssembleDensity,
        AssembleDensity => CorrectMirrored,
        CorrectMirrored => BoundPush,
        BoundPush => CorrectByLeast,
        CorrectByLeast => CorrectByMoments,
        CorrectByMoments => ShiftPoints,
        ShiftPoints => DisplacePoints,
        DisplacePoints => Collide,
        Collide => Average,
        Average => Gradient,
        Gradient => Laplacian,
        Laplacian => return None,
    })
}

#[test]
fn every_operation_has_a_scene() {
    let used: BTreeSet<Operation> =
        scenes::all().iter().flat_map(|(_, scene)| scene.plan.operations().collect::<Vec<_>>()).collect();
    assert_eq!(used, all().into_iter().collect());
}

/// That each engine does something by it is seen where the engines are compared.
#[test]
fn every_operation_has_a_shader_of_its_name() {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    for operation in all() {
        let (file, folder) = (shaders.join(operation.name()).with_extension("wgsl"), shaders.join(operation.name()));
        assert!(file.is_file() != folder.is_dir(), "{operation:?}: shaders/{}.wgsl or a folder", operation.name());
    }
}
