//! Whole runs: the same bits from the same seed, the same flow in f64, the same integral quantities in f32.

use std::sync::Arc;

use stillpoint::case::{Component, Line};
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::Precision;
use stillpoint::measure::{LineMeasure, Sampler};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Outcome, State, Stop, resume, simulate};

use crate::cases::{cavity_of, turning};
use crate::engines::{candidate, gpu};
use crate::rows::Rows;
use crate::scenes;

fn run(scene: &Scene, engine: &mut dyn Engine) -> (Outcome, Vec<Diagnostics>) {
    let mut rows = Rows::default();
    let outcome = simulate(scene, engine, &mut rows).expect("a run");
    assert_eq!(outcome.stop, Stop::End);
    (outcome, rows.rows)
}

/// Velocity components in m/s, pressures in Pa, and what is carried, one after the other.
fn numbers(outcome: &Outcome) -> Vec<f64> {
    let snapshot = &outcome.snapshot;
    let flow = snapshot.velocity.iter().flat_map(|u| u.to_array()).chain(snapshot.pressure.iter().copied());
    flow.chain(snapshot.carried.iter().flat_map(|(_, values)| values.iter().copied())).collect()
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    let Some(candidate) = candidate() else { return };
    let bits = |seed: &str| {
        let base = ["cloud.arrangement=jittered", "time.end=0.3", "output.report_every=3", seed];
        let scene = Arc::new(Scene::build(&cavity_of(16, &base)).expect("a scene"));
        let (outcome, rows) = run(&scene, &mut gpu(&candidate, &scene, Precision::Single));
        let rows = rows.iter().flat_map(|row| [row.kinetic_energy, row.divergence, row.residual, row.change]);
        numbers(&outcome).into_iter().chain(rows).map(f64::to_bits).collect::<Vec<_>>()
    };
    let first = bits("cloud.seed=1");
    assert!(first == bits("cloud.seed=1"));
    assert!(first != bits("cloud.seed=2"));
}

/// Keeps the state after so many rows.
struct Keeper(usize, Option<State>);

impl Observer for Keeper {
    fn report(&mut self, _: &Diagnostics) {
        self.0 = self.0.wrapping_sub(1);
    }

    fn stop_requested(&self) -> bool {
        false
    }

    fn keep(&mut self, state: &State) {
        if self.0 == 0 {
            self.1.get_or_insert_with(|| state.clone());
        }
    }
}

#[test]
fn a_run_in_two_gives_the_same_bits_as_one_in_one_go() {
    let Some(candidate) = candidate() else { return };
    for form in
        ["effects.pressure.form=conservative", "effects.pressure.form=collocated", "effects.viscosity.scheme=implicit"]
    {
        let base = ["cloud.arrangement=jittered", "time.end=0.3", "output.report_every=2", form];
        let scene = Arc::new(Scene::build(&cavity_of(16, &base)).expect("a scene"));
        let open = || gpu(&candidate, &scene, Precision::Single);
        let mut keeper = Keeper(2, None);
        let whole = simulate(&scene, &mut open(), &mut keeper).expect("a run");
        let state = keeper.1.expect("a state after two rows");
        assert!(state.progress.step == 4 && whole.steps > 4, "{form}");
        let rest = resume(&scene, &mut open(), &mut (), state).expect("the rest of it");
        assert!(numbers(&rest) == numbers(&whole), "{form}");
        assert_eq!(
            (rest.steps, rest.iterations, rest.state.progress),
            (whole.steps, whole.iterations, whole.state.progress)
        );
    }
}

#[test]
fn points_that_move_go_on_to_the_same_bits() {
    let Some(candidate) = candidate() else { return };
    for (name, scene) in scenes::all().into_iter().filter(|(_, scene)| scene.plan.moves()) {
        let open = || gpu(&candidate, &scene, Precision::Single);
        let mut keeper = Keeper(1, None);
        let whole = simulate(&scene, &mut open(), &mut keeper).expect("a run");
        let state = keeper.1.expect("a state after a row");
        assert!(state.progress.step > 0 && whole.steps > state.progress.step, "{name}");
        let rest = resume(&scene, &mut open(), &mut (), state).expect("the rest of it");
        assert!(numbers(&rest) == numbers(&whole) && rest.snapshot == whole.snapshot, "{name}");
        assert_eq!((rest.steps, rest.state), (whole.steps, whole.state), "{name}");
    }
}

#[test]
fn a_whole_run_in_f64_agrees_with_the_cpu() {
    let Some(candidate) = candidate().filter(|candidate| candidate.double_precision) else { return };
    let collocated = [
        "effects.pressure.form=collocated",
        "effects.advection.remap=forward",
        "time.courant=0.5",
        "effects.pressure.tolerance=1e-12",
    ];
    let projection = ["time.splitting=projection", "effects.pressure.gradient=adjoint"];
    let (heated, open) = (scenes::heated(), scenes::OPEN);
    let base = ["cloud.arrangement=jittered", "effects.pressure.tolerance=1e-11", "time.end=0.3"];
    let implicit = ["effects.viscosity={ kinematic = 0.2, scheme = 'implicit', tolerance = 1e-11 }"];
    let flows = [&[][..], &collocated, &projection, &heated, &open, &implicit]
        .map(|changes| (changes, scenes::of(&[&base, changes].concat())));
    let turning = Scene::build(&turning(14, &[base[0], base[2]])).expect("a scene");
    for (changes, scene) in flows.into_iter().chain([(&[][..], turning)]) {
        let scene = Arc::new(scene);
        let (ours, _) = run(&scene, &mut gpu(&candidate, &scene, Precision::Double));
        let (theirs, _) = run(&scene, cpu::double(&scene).expect("an engine").as_mut());
        assert_eq!((ours.steps, ours.fallbacks), (theirs.steps, theirs.fallbacks));
        for (k, (ours, theirs)) in numbers(&ours).into_iter().zip(numbers(&theirs)).enumerate() {
            assert!((ours - theirs).abs() < 1e-8, "{changes:?}: number {k}: {ours}, {theirs}");
        }
    }
}

/// What is judged of the cavity: kinetic energy, and the extremes of both profiles.
fn cavity_quantities(scene: &Scene, engine: &mut dyn Engine) -> [(&'static str, f64); 4] {
    let (outcome, rows) = run(scene, engine);
    let snapshot = &outcome.snapshot;
    assert!((snapshot.time - 1.0).abs() < 1e-12);
    let sampler = Sampler::new(&snapshot.position, scene.constants.spacing).expect("a sampler");
    let along =
        |component, line| LineMeasure::new(&sampler, snapshot, &scene.case.domain, component, line).expect("a profile");
    let (u, v) = (along(Component::U, Line::X(0.5)), along(Component::V, Line::Y(0.5)));
    [
        ("kinetic energy", rows.last().expect("a row").kinetic_energy),
        ("u_min", u.minimum().value),
        ("v_min", v.minimum().value),
        ("v_max", v.maximum().value),
    ]
}

#[test]
fn the_cavity_in_f32_has_the_energy_and_the_extremes_of_the_cpu_in_f64() {
    let Some(candidate) = candidate() else { return };
    let scene = Arc::new(Scene::build(&cavity_of(16, &[])).expect("a scene"));
    let ours = cavity_quantities(&scene, &mut gpu(&candidate, &scene, Precision::Single));
    let theirs = cavity_quantities(&scene, cpu::double(&scene).expect("an engine").as_mut());
    for ((name, ours), (_, theirs)) in ours.into_iter().zip(theirs) {
        assert!((ours - theirs).abs() <= 1e-4 * theirs.abs() && theirs.abs() > 1e-3, "{name}: {ours}, {theirs}");
    }
}
