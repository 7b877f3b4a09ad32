//! Hard cases of the length of steps, of viscosity, and of how a flow begins.

use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::scene::Scene;
use stillpoint::step::Buffer;

use crate::cases::{FIT, cavity_of};
use crate::flow::{flow, flow_of};
use crate::table::{Promise, Row};

fn plain(changes: &[&str]) -> Case {
    cavity_of(16, changes)
}

/// A step so many times the time that diffusion takes over a spacing, `l0^2 / nu`, at a viscosity of 1 m^2/s.
pub fn viscous(number: f64, changes: &[&str]) -> Case {
    let (step, end) = (number / 256.0, (40.0 * number / 256.0).min(4.0));
    let keys = [format!("time.step={step:e}"), format!("time.end={end:e}")];
    let keys: Vec<&str> = keys.iter().map(String::as_str).chain(["effects.viscosity.kinematic=1.0"]).collect();
    plain(&[&keys[..], changes].concat())
}

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut row = |case: &str, promise: Promise, made: &Case, expected: Option<f64>| {
        rows.push(Row::of_flow(case, promise, &flow_of(made), expected));
    };
    // Long and short steps. What is right is the flow at a tenth of the step that is taken by itself.
    let right = flow_of(&plain(&["time.end=4.0", "time.courant=0.08"])).expect("a flow").energy();
    for (courant, promise) in [
        ("0.05", Promise::Right(0.05)),
        ("1", Promise::Right(0.2)),
        ("5", Promise::Bounded(1.0)),
        ("50", Promise::Bounded(1.0)),
    ] {
        let made = plain(&["time.end=4.0", &format!("time.courant={courant}")]);
        row(&format!("{courant} spacings a step"), promise, &made, Some(right));
    }
    row(
        "50 spacings a step, jittered",
        Promise::Bounded(1.0),
        &plain(&["cloud.arrangement=jittered", "time.courant=50"]),
        None,
    );
    let keys = ["effects.pressure.form=collocated", "time.courant=5", "time.end=4.0"];
    row("5 spacings a step, collocated", Promise::Bounded(1.0), &plain(&keys), None);
    let forward = crate::table_of_input::from_keys(&["effects.advection.remap=forward", "time.courant=5"]);
    rows.push(Row::of_flow("5 spacings a step, forward remap", Promise::Refused("must be at most 1"), &forward, None));
    let mut row = |case: &str, promise: Promise, made: &Case, expected: Option<f64>| {
        rows.push(Row::of_flow(case, promise, &flow_of(made), expected));
    };
    // Viscosity, explicit.
    row("viscous number 10", Promise::Mended, &viscous(10.0, &["guard.retries=8"]), None);
    row("viscous number 10, no retries", Promise::Flagged, &viscous(10.0, &["guard.retries=0"]), None);
    row("viscous number 1000", Promise::Flagged, &viscous(1000.0, &[]), None);
    row("viscous number 1000, 20 retries", Promise::Mended, &viscous(1000.0, &["guard.retries=20"]), None);
    let keys = ["effects.pressure.form=collocated", "guard.retries=8"];
    row("viscous number 10, collocated", Promise::Mended, &viscous(10.0, &keys), None);
    // Reynolds numbers that the points do not resolve.
    for (reynolds, viscosity) in [("1e4", "1e-4"), ("1e6", "1e-6")] {
        let viscosity = format!("effects.viscosity.kinematic={viscosity}");
        for (name, changes) in [
            ("", &[][..]),
            (", adjoint", &["effects.pressure.gradient=adjoint"]),
            (", jittered, fitted faces", &["cloud.arrangement=jittered", FIT]),
        ] {
            let made = plain(&[changes, &[viscosity.as_str(), "time.end=20.0"]].concat());
            row(&format!("Re {reynolds} on 17 x 17 points{name}"), Promise::Bounded(1.0), &made, None);
        }
    }
    let mut inviscid = plain(&["time.end=20.0"]);
    inviscid.effects.viscosity = None;
    row("no viscosity at all", Promise::Bounded(1.0), &inviscid, None);
    // Creeping flow: at the same time nu t / L^2 that of Re 0.1.
    let creeping = |viscosity: &str, end: &str, more: &[&str]| {
        let keys = [format!("effects.viscosity.kinematic={viscosity}"), format!("time.end={end}")];
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        flow_of(&plain(&[&keys[..], more].concat()))
    };
    let slow = creeping("10.0", "0.01", &[]).expect("a flow").energy();
    // The tolerance is that of the volume change in a step, and the steps are as short as the flow is slow.
    let tight = creeping("1000.0", "1e-4", &["effects.pressure.tolerance=1e-10"]);
    let case = "Re 0.001 with a tolerance of 1e-10, against Re 0.1";
    rows.push(Row::of_flow(case, Promise::Right(0.01), &tight, Some(slow)));
    rows.push(Row::of_flow("Re 0.001", Promise::Bounded(1.0), &creeping("1000.0", "1e-4", &[]), None));
    // Impulsive starts.
    let mut row = |case: &str, promise: Promise, made: &Case, expected: Option<f64>| {
        rows.push(Row::of_flow(case, promise, &flow_of(made), expected));
    };
    let all = [
        "boundaries.bottom.velocity=[-1.0, 0.0]",
        "boundaries.left.velocity=[0.0, 1.0]",
        "boundaries.right.velocity=[0.0, -1.0]",
        "effects.viscosity.kinematic=1e-6",
        "time.courant=5",
        "time.end=10.0",
    ];
    row("four walls set off at once, Re 1e6, 5 spacings a step", Promise::Bounded(1.0), &plain(&all), None);
    let faster = ["boundaries.top.velocity=[1e6, 0.0]", "effects.viscosity.kinematic=1e4", "time.end=1e-6"];
    let fast = flow_of(&plain(&faster));
    let same = flow_of(&plain(&[])).expect("a flow").energy();
    rows.push(Row::of_flow("a lid of 1e6 m/s at Re 100", Promise::Right(1e-6), &fast, Some(same * 1e12)));
    rows.push(large_and_tiny());
    // Figures at the end of what numbers hold.
    let mut row = |case: &str, promise: Promise, made: &Case| {
        rows.push(Row::of_flow(case, promise, &flow_of(made), None));
    };
    row("time.end = 1e-300 s", Promise::Flagged, &plain(&["time.end=1e-300"]));
    row("time.end = 1e300 s", Promise::Refused("make more than 1e9 of them"), &plain(&["time.end=1e300"]));
    row(
        "viscosity 1e300 m^2/s",
        Promise::Refused("(viscosity) make more than 1e9"),
        &plain(&["effects.viscosity.kinematic=1e300"]),
    );
    row(
        "viscosity 1e-300 m^2/s",
        Promise::Bounded(1.0),
        &plain(&["effects.viscosity.kinematic=1e-300", "time.end=4.0"]),
    );
    let light = ["boundaries.top.velocity=[1e200, 0.0]", "time.end=1e-201", "time.courant=0.8"];
    row(
        "a lid of 1e200 m/s, whose energy no number holds",
        Promise::Refused("make more than 1e9 of them"),
        &plain(&light),
    );
    let single = flow(&plain(&["fluid.density=1e38"]), None, cpu::single);
    rows.push(Row::of_flow("density 1e38 kg/m^3, f32", Promise::Flagged, &single, None));
    let dense = flow_of(&plain(&["fluid.density=1e38"]));
    rows.push(Row::of_flow("density 1e38 kg/m^3", Promise::Right(1e-6), &dense, Some(same)));
    rows
}

/// Steps of two spacings, of a millionth of that, and again of two.
fn large_and_tiny() -> Row {
    let scene = Arc::new(Scene::build(&plain(&[])).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let apply = |engine: &mut dyn Engine, operations: &[stillpoint::step::Operation], dt: f64| {
        operations.iter().try_for_each(|&operation| engine.apply(operation, &scene.clock(dt)))
    };
    apply(engine.as_mut(), &scene.plan.setup, 1.0).expect("the setup");
    apply(engine.as_mut(), &scene.plan.kick, 0.1).expect("a kick");
    let mut energies = Vec::new();
    for (steps, dt) in [(10, 0.1), (10, 1e-7), (10, 0.1), (1, 1e-7), (10, 0.1)] {
        let advance = engine.advance(steps, &scene.clock(dt)).expect("steps");
        assert_eq!(advance.trouble, None);
        energies.push(engine.measure(1.0).expect("figures").kinetic_energy / scene.energy_scale().unwrap_or(1.0));
    }
    let most = energies.iter().copied().fold(0.0, f64::max);
    let finite = matches!(engine.read(Buffer::Projected), Ok(stillpoint::engine::Data::Real(u)) if u.iter().all(|u| u.is_finite()));
    let words = "energy at most 1 of the walls'";
    Row::new("steps of 0.1 s and of 1e-7 s in turns", words, format!("energy {most:.2e}"), finite && most <= 1.0)
}
