//! Every option changes the answer, and what is to leave it alone does.

use glam::DVec2;
use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};

use crate::bench::most;
use crate::cases::cavity;

/// A fifth of a second of the cavity on a jittered cloud, the same number of steps whatever the options.
fn run(overrides: &[&str]) -> Outcome {
    let base = [
        "cloud.spacing=0.0625",
        "cloud.arrangement=jittered",
        "time.end=0.2",
        "time.step=0.02",
        "effects.pressure.tolerance=1e-9",
    ];
    let scene = Scene::build(&cavity(&[&base, overrides].concat())).expect("a scene").into();
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    let (velocity, pressure) = (&outcome.snapshot.velocity, &outcome.snapshot.pressure);
    assert!(velocity.iter().all(|u| u.is_finite()) && pressure.iter().all(|p| p.is_finite()), "{overrides:?}");
    outcome
}

/// Largest difference in velocity, m/s; in pressure, Pa.
fn difference(a: &Outcome, b: &Outcome) -> [f64; 2] {
    let velocity = a.snapshot.velocity.iter().zip(&b.snapshot.velocity).map(|(a, b): (&DVec2, _)| (*a - *b).length());
    let pressure = a.snapshot.pressure.iter().zip(&b.snapshot.pressure).map(|(a, b)| (a - b).abs());
    [velocity.fold(0.0, most), pressure.fold(0.0, most)]
}

#[test]
fn every_option_changes_the_answer() {
    let base = run(&[]);
    for changed in [
        "method.weight=none",
        "method.weight=quadratic",
        "method.order=3",
        "method.order=4",
        "method.operators=integral",
        "method.radius=3.1",
        "effects.viscosity.kinematic=0.011",
        "effects.pressure.form=collocated",
        "effects.pressure.gradient=adjoint",
        "effects.pressure.divergence=fit",
        "effects.pressure.tolerance=1e-2",
        "effects.advection.remap=forward",
        "time.splitting=projection",
        "time.step=0.01",
        "time.end=0.22",
        "boundaries.top.velocity=[1.1, 0.0]",
        "boundaries.bottom.velocity=[0.1, 0.0]",
        "boundaries.left.velocity=[0.0, 0.1]",
        "boundaries.right.velocity=[0.0, 0.1]",
        "cloud.seed=2",
        "cloud.jitter=0.2",
    ] {
        let [velocity, _] = difference(&run(&[changed]), &base);
        assert!(velocity > 1e-5, "{changed} changes velocities by {velocity:e} m/s alone");
    }
}

#[test]
fn options_that_choose_the_way_and_not_the_answer_leave_it() {
    let base = run(&[]);
    for changed in [
        "effects.pressure.solver=bicgstab",
        "effects.pressure.solver=direct",
        "effects.pressure.preconditioner=jacobi",
        "output.report_every=3",
    ] {
        let [velocity, pressure] = difference(&run(&[changed]), &base);
        assert!(velocity < 1e-6 && pressure < 1e-5, "{changed}: {velocity:e} m/s, {pressure:e} Pa");
    }
}

#[test]
fn the_pressure_is_proportional_to_the_density_and_the_velocity_does_not_see_it() {
    let (light, heavy) =
        (run(&["effects.pressure.solver=direct"]), run(&["effects.pressure.solver=direct", "fluid.density=1000.0"]));
    let [velocity, _] = difference(&light, &heavy);
    assert!(velocity < 1e-12, "{velocity:e}");
    let size = light.snapshot.pressure.iter().map(|p| p.abs()).fold(0.0, most);
    let off = light.snapshot.pressure.iter().zip(&heavy.snapshot.pressure).map(|(l, h)| (l - h / 1000.0).abs());
    assert!(off.fold(0.0, most) < 1e-10 * size);
}

#[test]
fn an_absent_effect_changes_the_answer() {
    let base = run(&[]);
    type Removal = fn(&mut stillpoint::case::Effects);
    let removals: [(&str, Removal); 3] = [
        ("viscosity", |effects| effects.viscosity = None),
        ("pressure", |effects| effects.pressure = None),
        ("advection", |effects| effects.advection = None),
    ];
    for (name, remove) in removals {
        let mut case = base_case();
        remove(&mut case.effects);
        let scene = Scene::build(&case).expect("a scene").into();
        let mut engine = cpu::double(&scene).expect("an engine");
        let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
        assert!(difference(&outcome, &base)[0] > 1e-3, "without {name}");
    }
}

fn base_case() -> stillpoint::case::Case {
    cavity(&["cloud.spacing=0.0625", "cloud.arrangement=jittered", "time.end=0.2", "time.step=0.02"])
}
