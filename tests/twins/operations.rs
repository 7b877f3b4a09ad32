//! Operation by operation: every engine begins from the same numbers, so that errors do not pile up.

use std::collections::BTreeSet;
use std::sync::Arc;

use stillpoint::case::PressureForm;
use stillpoint::cpu::operations::moving::density;
use stillpoint::direct::DirectSolver;
use stillpoint::engine::{Clock, Data, Engine, Outcome, SolveInfo};
use stillpoint::scene::Scene;
use stillpoint::step::{Buffer, Operation, Points, Rung, Stage};

use crate::compare::{Difference, FACTOR, Results, allowed, compare, entries};
use crate::engines::{Engines, State, candidate, read, reals, rounded, write};
use crate::{coverage, scenes};

/// Steps after which the flow has developed.
const STEPS: u32 = 8;

/// One operation of one scene, done by all three engines on the same input.
struct Done<'a> {
    scene: &'a Arc<Scene>,
    operation: Operation,
    clock: Clock,
    before: State,
    /// CPU f64, CPU f32, GPU f32.
    after: [State; 3],
    engines: &'a mut Engines,
}

impl Done<'_> {
    fn differences(&self) -> Vec<Difference> {
        let [double, single, gpu] = &self.after;
        let of = |buffer| Results { double: &double[&buffer], single: &single[&buffer], gpu: &gpu[&buffer] };
        compared(self.operation)
            .into_iter()
            .filter_map(|buffer| compare(self.scene, self.operation, buffer, &of(buffer), self.slack()))
            .collect()
    }

    /// Below the floor a solve stops where it is. Where the GPU got there in fewer iterations than the CPU in f32, what it leaves is as
    /// much larger as its residual, which `residuals_agree` holds to the floor.
    fn slack(&self) -> f64 {
        let [single, gpu] = [self.engines.single.solve_info(), self.engines.gpu.solve_info()];
        let sooner = iterates(self.operation) && gpu.iterations < single.iterations;
        if sooner { (gpu.last_residual / single.last_residual).max(1.0) } else { 1.0 }
    }
}

fn iterates(operation: Operation) -> bool {
    matches!(operation, Operation::ConjugateGradient | Operation::Bicgstab)
}

/// What an operation is judged by. The vectors of a solver are on their way to nowhere when it stops; it has the pressure to
/// show, and its residual.
fn compared(operation: Operation) -> Vec<Buffer> {
    match operation {
        Operation::ImplicitViscosity => vec![Buffer::Middle],
        _ if iterates(operation) => vec![Buffer::Pressure],
        _ => operation.writes(),
    }
}

/// The arrays that an operation fills whatever they held. Erased before, so that one that does nothing is seen: a steady
/// flow gives the same again.
fn made_anew(operation: Operation) -> Vec<Buffer> {
    match operation {
        Operation::AssembleMirrored | Operation::AssembleDensity => vec![Buffer::MatrixRow],
        Operation::FindNeighbours(points) => vec![Buffer::Neighbours(points), Buffer::NeighbourCount(points)],
        Operation::BuildCells(_)
        | Operation::FindLocalNeighbours
        | Operation::Factorise(_)
        | Operation::AssembleLaplacian
        | Operation::AssembleGradient
        | Operation::AssembleIntegralLaplacian
        | Operation::AssembleIntegralGradient
        | Operation::AssembleCollocated
        | Operation::FactoriseMirrored
        | Operation::FitPredicted
        | Operation::FitMirrored
        | Operation::FindSurface
        | Operation::FitVelocity(_)
        | Operation::FindDepartures
        | Operation::FitScalar(_)
        | Operation::Diffuse(_, Stage::Start)
        | Operation::MovePoints
        | Operation::KeepVelocity
        | Operation::Predict
        | Operation::PredictImplicit
        | Operation::MeanKickByFit
        | Operation::MeanKickByAdjoint
        | Operation::Divergence
        | Operation::DivergenceByFit
        | Operation::CollocatedSource
        | Operation::Coarsen
        | Operation::DirectSolve
        | Operation::Average
        | Operation::Gradient
        | Operation::Laplacian => operation.writes(),
        _ => vec![],
    }
}

/// Applies `operation` to `before` on every engine.
fn apply(engines: &mut Engines, operation: Operation, clock: &Clock, before: &State) -> [State; 3] {
    let writes = operation.writes();
    engines.each().map(|engine| {
        write(engine, before);
        engine.apply(operation, clock).unwrap_or_else(|error| panic!("{operation:?}: {error}"));
        read(engine, &writes)
    })
}

/// Runs the setup, develops the flow, and goes through one step; `look` sees every operation done.
fn walk(scene: &Arc<Scene>, engines: &mut Engines, look: &mut dyn FnMut(Done)) {
    let buffers = scene.plan.buffers();
    let clock = Clock { share: 0.7, ..scene.clock(0.5 * scene.constants.spacing) };
    let mut through = |operations: &[Operation], engines: &mut Engines| {
        for &operation in operations {
            let mut before = rounded(read(engines.double.as_mut(), &buffers));
            for buffer in made_anew(operation) {
                before.insert(buffer, scene.zeros(buffer));
            }
            let after = apply(engines, operation, &clock, &before);
            look(Done { scene, operation, clock, before, after, engines });
        }
    };
    through(&scene.plan.setup, engines);
    through(&scene.plan.on_step, engines);
    for &operation in &scene.plan.on_step {
        engines.double.apply(operation, &clock).expect("what a step begins with");
    }
    if !scene.plan.flows {
        return through(&scene.plan.kick, engines);
    }
    if scene.cloud.normal.is_empty() && !scene.plan.moves() {
        stir(scene, engines.double.as_mut());
    }
    // Points that move begin with the drift, which searches for neighbours.
    for &operation in scene.plan.kick.iter().filter(|_| !scene.plan.moves()) {
        engines.double.apply(operation, &Clock { second_kick: 0.0, ..clock }).expect("a first kick");
    }
    let done = engines.double.advance(STEPS, &clock).expect("steps");
    assert_eq!((done.steps, done.trouble), (STEPS, None));
    through(&scene.plan.drift, engines);
    through(&scene.plan.kick, engines);
}

/// A flow where no wall drives one.
fn stir(scene: &Scene, engine: &mut dyn Engine) {
    let velocity: Vec<_> =
        scene.cloud.position.iter().map(|p| glam::DVec2::new((0.7 * p.y).sin(), (0.9 * p.x).cos())).collect();
    engine.write(Buffer::Velocity, &scene.vectors(&velocity, glam::DVec2::ZERO)).expect("a velocity");
}

#[test]
fn every_operation_of_every_scene_agrees_to_rounding() {
    let Some(candidate) = candidate() else { return };
    // Operations that changed something: of each engine.
    let mut worked: [BTreeSet<Operation>; 3] = Default::default();
    let mut rungs = BTreeSet::new();
    let mut failures = Vec::new();
    for (name, scene) in scenes::all() {
        let mut engines = Engines::new(&candidate, &scene);
        walk(&scene, &mut engines, &mut |done| {
            failures.extend(done.differences().into_iter().map(|difference| format!("{name}: {difference:?}")));
            for (worked, after) in worked.iter_mut().zip(&done.after) {
                if after.iter().any(|(buffer, data)| data != &done.before[buffer]) {
                    worked.insert(done.operation);
                }
            }
            if let Some(Data::Index(of)) = done.after[0].get(&Buffer::Rung(Points::Standing))
                && done.operation == Operation::WidenSupport(Points::Standing)
            {
                rungs.extend(of[..scene.sizes.points].iter().copied());
            }
            if done.operation == Operation::ImplicitViscosity {
                let infos = done.engines.each().map(|engine| engine.viscous_solve_info().expect("a solve"));
                let ended = |info: &SolveInfo| info.outcome == Outcome::Converged && info.iterations > 3;
                assert!(infos.iter().all(ended), "{name}: {infos:?}");
            }
            if iterates(done.operation) {
                residuals_agree(name, done);
            }
        });
    }
    assert!(failures.is_empty(), "{} arrays differ:\n{}", failures.len(), failures.join("\n"));
    let all: BTreeSet<Operation> = coverage::all().into_iter().collect();
    assert_eq!(worked, [(); 3].map(|()| all.clone()), "an operation that changes nothing was not tested");
    assert_eq!(rungs, (0..=Rung::NEAREST).collect(), "rungs of the ladder that were tested");
}

/// A solve has ended where f32 can get to, says so truly, and the GPU's is no worse than the CPU's.
fn residuals_agree(name: &str, done: Done) {
    let Done { scene, operation, before, after, engines, .. } = done;
    let Data::Real(source) = &before[&Buffer::Source] else { panic!("a source") };
    let direct = DirectSolver::new(scene, &mut |buffer| engines.double.read(buffer)).expect("a factorisation");
    let infos = engines.each().map(|engine| engine.solve_info());
    let residuals = after.each_ref().map(|after| {
        let Data::Real(pressure) = &after[&Buffer::Pressure] else { panic!("a pressure") };
        direct.residual(scene, source, pressure)
    });
    // What rounding leaves of the product of the matrix with the pressure: the floor of the solvers.
    let (diagonal, pressure) =
        (reals(engines.single.as_mut(), Buffer::Diagonal), reals(engines.single.as_mut(), Buffer::Pressure));
    let volume = reals(engines.single.as_mut(), Buffer::Volume);
    let points = scene.sizes.points;
    let size = |i: usize| {
        let size = diagonal[i] * pressure[i];
        match scene.plan.form {
            Some(PressureForm::Conservative) => size / volume[i],
            Some(PressureForm::Integral) => size * density::per_area(scene.constants.lattice),
            _ => size,
        }
    };
    let rms = ((0..points).map(|i| size(i).powi(2)).sum::<f64>() / points as f64).sqrt();
    let floor = scene.constants.floor * f64::from(f32::EPSILON) * rms;
    let say = format!("{name}, {operation:?}: {infos:?}; recomputed {residuals:?}, floor {floor}");
    for (info, residual) in infos.iter().zip(residuals) {
        assert!(info.outcome == Outcome::Converged && info.iterations > 5, "{say}");
        assert!((info.last_residual - residual).abs() <= floor, "{say}");
        assert!(residual <= 2.0 * floor && info.first_residual > 10.0 * floor, "{say}");
    }
    let [_, single, gpu] = residuals;
    let sooner = infos[2].iterations < infos[1].iterations;
    assert!(sooner || gpu <= FACTOR * single, "{say}");
}

/// Every array that any operation writes, spoiled in one entry by three times what is allowed, is found out.
#[test]
fn a_planted_difference_is_reported_with_its_operation_its_array_and_its_point() {
    let Some(candidate) = candidate() else { return };
    for (name, scene) in scenes::all() {
        let mut engines = Engines::new(&candidate, &scene);
        walk(&scene, &mut engines, &mut |mut done| {
            let slack = done.slack();
            for buffer in compared(done.operation) {
                let (entry, point) = middle(&scene, buffer);
                let kept = done.after[2].clone();
                let [double, single, gpu] = &mut done.after;
                let results = Results { double: &double[&buffer], single: &single[&buffer], gpu: &gpu[&buffer] };
                let by = 3.0 * allowed(&scene, buffer, &results, slack);
                match gpu.get_mut(&buffer).expect("an array") {
                    Data::Real(values) => values[entry] += by.max(f64::from(f32::MIN_POSITIVE)),
                    Data::Index(values) => values[entry] = values[entry].wrapping_add(1),
                }
                let found: Vec<_> = done.differences().iter().map(|d| (d.operation, d.buffer, d.point)).collect();
                assert_eq!(found, [(done.operation, buffer, point)], "{name}, by {by:e}");
                done.after[2] = kept;
            }
        });
    }
}

/// An entry in the middle of an array, and whose it is.
fn middle(scene: &Scene, buffer: Buffer) -> (usize, usize) {
    let all: Vec<_> = entries(scene, buffer).collect();
    all[all.len() / 2]
}

/// A difference in what the GPU reads shows in what it writes, there.
#[test]
fn a_difference_of_input_shows_where_it_was_planted() {
    let Some(candidate) = candidate() else { return };
    let scene = Arc::new(scenes::of(&["cloud.arrangement=jittered"]));
    let (moving, point) = (scene.plan.moving(), 123);
    let mut engines = Engines::new(&candidate, &scene);
    let mut planted = 0;
    walk(&scene, &mut engines, &mut |mut done| {
        if !matches!(done.operation, Operation::FitVelocity(_) | Operation::RemapDeparture) {
            return;
        }
        let Some(Data::Real(values)) = done.before.get_mut(&moving) else { panic!("a velocity") };
        // m/s, of a flow of 1 m/s.
        values[2 * point] += 1e-4;
        let gpu = &mut done.engines.gpu;
        write(gpu, &done.before);
        gpu.apply(done.operation, &done.clock).expect("an operation");
        done.after[2] = read(gpu, &done.operation.writes());
        let differences = done.differences();
        let [difference] = &differences[..] else { panic!("{differences:?}") };
        let away = scene.cloud.position[difference.point].distance(scene.cloud.position[point]);
        assert!(away < scene.constants.radius, "{difference:?}: {away} m away");
        planted += 1;
    });
    assert_eq!(planted, 2);
}
