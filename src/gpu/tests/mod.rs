//! The kernels: their sources, and what they compute.

#[path = "../../../tests/support/adapter.rs"]
mod needed;
mod runs;
mod sources;
mod trouble;

use std::path::Path;
use std::sync::Arc;

use super::adapter::{self, Candidate};
use super::{Gpu, GpuEngine, Precision};
use crate::case::Case;
use crate::engine::Engine;
use crate::scene::Scene;

/// A small cavity; together the changes below use every operation.
const CAVITY: &str = r#"
title = "a cavity"
[domain]
width = 1.0
height = 1.0
[cloud]
arrangement = "jittered"
spacing = 0.0625
[fluid]
density = 2.0
[boundaries]
top.velocity = [1.0, 0.0]
[effects.viscosity]
kinematic = 0.01
[effects.pressure]
[effects.advection]
[time]
end = 1.0
"#;

/// What the scenes of the tests change in it.
const CHANGES: [&[&str]; 9] = [
    &[],
    &["effects.pressure.gradient=\"adjoint\"", "effects.pressure.solver=\"bicgstab\"", "method.weight=\"none\""],
    &[
        "effects.pressure.form=\"collocated\"",
        "time.splitting=\"projection\"",
        "effects.advection.remap=\"forward\"",
        "cloud.arrangement=\"regular\"",
    ],
    &["effects.pressure.solver=\"direct\"", "effects.gravity.acceleration=[0.3, -1.0]"],
    &[
        "effects.pressure.tolerance=1e-4",
        "effects.pressure.preconditioner=\"jacobi\"",
        "method.weight=\"quadratic\"",
        "cloud.arrangement=\"random\"",
        "time.splitting=\"projection\"",
    ],
    &["effects.drag={ permeability = 1e-3, inertia = 2.0, circle = { centre = [0.4, 0.5], radius = 0.2 } }"],
    &["effects.drag.permeability=1e-2", "time.splitting=\"projection\""],
    &["effects.viscosity.scheme=\"implicit\"", "effects.viscosity.tolerance=1e-9"],
    &[
        "effects.viscosity.scheme=\"implicit\"",
        "effects.viscosity.tolerance=1e-9",
        "effects.pressure.gradient=\"adjoint\"",
        "time.splitting=\"projection\"",
        "effects.gravity.acceleration=[0.3, -1.0]",
    ],
];

const FIT: &str = "effects.pressure.divergence=\"fit\"";
/// A flow through a box, and one in a box that repeats.
const WAKE: &str = "[exact]\nsolution = \"kovasznay\"\n";
const VORTICES: &str = "[exact]\nsolution = \"taylor_green\"\n";

fn scene_of(text: &str, changes: &[&str]) -> Scene {
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    let case = Case::from_text(text, Path::new("cavity.toml"), &changes).expect("a case");
    Scene::build(&case).expect("a scene")
}

fn scene(changes: &[&str]) -> Scene {
    scene_of(CAVITY, changes)
}

fn still_scene() -> Scene {
    scene_of(&CAVITY.replace("[effects.advection]\n", ""), &[])
}

/// No pressure: nothing but viscosity and advection.
fn forceless_scene() -> Scene {
    scene_of(&CAVITY.replace("[effects.pressure]\n", ""), &[])
}

/// Heat that drives the flow, and a tracer that it carries.
fn heated_scene() -> Scene {
    let tracer =
        "[[effects.tracers]]\nname = \"c\"\ndiffusivity = 0.1\nshape = \"disc\"\ncentre = [0.5, 0.5]\nradius = 0.2\n";
    let changes = [
        "effects.heat.diffusivity=0.02",
        "effects.gravity.acceleration=[0.0, -1.0]",
        "effects.buoyancy.expansion=0.1",
        "boundaries.left.temperature=1.0",
        "boundaries.right.heat_flux=-0.1",
    ];
    scene_of(&(CAVITY.to_owned() + tracer), &changes)
}

/// Fluid comes in on one side, leaves on another, and slides along a third.
fn channel_scene() -> Scene {
    let changes = [
        "boundaries.left={ kind = \"inlet\", velocity = [1.0, 0.0] }",
        "boundaries.right={ kind = \"outlet\" }",
        "boundaries.bottom={ kind = \"slip\" }",
    ];
    scene_of(CAVITY, &changes)
}

/// The same with the collocated pressure.
fn collocated_channel_scene() -> Scene {
    let changes = [
        "effects.pressure.form=\"collocated\"",
        "boundaries.left={ kind = \"inlet\", velocity = [1.0, 0.0] }",
        "boundaries.right={ kind = \"outlet\" }",
    ];
    scene_of(CAVITY, &changes)
}

/// Fluid comes and goes through the sides.
fn open_scene() -> Scene {
    scene_of(&(CAVITY.replace("top.velocity = [1.0, 0.0]\n", "") + WAKE), &[FIT])
}

/// What leaves one side comes in at the other.
fn periodic_scene() -> Scene {
    let changes = ["domain.periodic=\"both\"", "effects.advection.remap=\"forward\"", FIT];
    scene_of(&(CAVITY.replace("top.velocity = [1.0, 0.0]\n", "") + VORTICES), &changes)
}

/// Points that move: shifted, and MPS.
fn moving_scenes() -> [Scene; 3] {
    let text = CAVITY
        .replace("top.velocity = [1.0, 0.0]\n", "")
        .replace("spacing = 0.0625", "spacing = 0.0625\nfill = { from = [0.0, 0.0], to = [0.5, 0.5] }")
        + "[effects.gravity]\nacceleration = [0.0, -1.0]\n";
    const CORRECTED: &str = "effects.pressure.gradient=\"corrected\"";
    const JACOBI: &str = "effects.pressure.preconditioner=\"jacobi\"";
    let lagrangian = ["effects.advection.motion=\"lagrangian\"", "method.operators=\"integral\""];
    [
        scene_of(&text, &["effects.advection.motion=\"shifted\"", "time.courant=0.2"]),
        scene_of(&text, &[&lagrangian[..], &["time.courant=0.2"]].concat()),
        scene_of(&text, &[&lagrangian[..], &["time.courant=0.2", CORRECTED, JACOBI]].concat()),
    ]
}

/// Points that lie closer under the lid.
fn graded_scene() -> Scene {
    let refined = "[[cloud.refine]]\nnear = \"top\"\nspacing = 0.03125\n";
    scene_of(&(CAVITY.replace("\"jittered\"", "\"relaxed\"") + refined), &[])
}

/// The adapter that the tests run on; `None` where those that need one are skipped.
fn candidate() -> Option<Candidate> {
    (!needed::skipped(&[include_str!("runs.rs"), include_str!("trouble.rs")]))
        .then(|| needed::required(adapter::choose(None)))
}

/// An engine as it is made.
fn made(scene: &Arc<Scene>, precision: Precision) -> Option<GpuEngine> {
    let candidate = candidate()?;
    let gpu = Gpu::open(&candidate, precision).expect("the adapter opens");
    Some(GpuEngine::new(Arc::clone(scene), gpu).expect("the kernels compile"))
}

/// The same, set up.
fn engine(scene: Scene, precision: Precision) -> Option<GpuEngine> {
    let scene = Arc::new(scene);
    let mut engine = made(&scene, precision)?;
    for &operation in &scene.plan.setup {
        engine.apply(operation, &scene.clock(1.0)).expect("setup");
    }
    Some(engine)
}
