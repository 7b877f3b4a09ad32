//! A selection of the hard cases on a GPU, in f32. The quick ones run with the other tests, all of them, half a minute of a software
//! adapter, by `cargo test --test hard -- --ignored a_selection`.

use std::sync::Arc;

use stillpoint::cloud::Cloud;
use stillpoint::engine::{Engine, EngineError};
use stillpoint::gpu::{self, Gpu, GpuEngine, Precision};
use stillpoint::scene::Scene;

use crate::adapter::{required, skipped};
use crate::cases::{FIT, cavity_of, vortices};
use crate::columns::{MPS, column};
use crate::flow::{flow, flow_of, flow_on};
use crate::spoiled::Spoiled;
use crate::table::{Promise, Row, hold};
use crate::table_of_motion::{self as motion, Kept};
use crate::{table_of_points as points, table_of_time as time};

fn open(scene: &Arc<Scene>) -> Result<Box<dyn Engine>, EngineError> {
    let gpu = Gpu::open(&gpu::adapter::choose(None)?, Precision::Single)?;
    Ok(Box::new(GpuEngine::new(Arc::clone(scene), gpu)?))
}

/// True where there is to be none.
pub fn left_out() -> bool {
    let skipped = skipped(&[include_str!("table_on_gpu.rs")]);
    if !skipped {
        required(gpu::adapter::choose(None));
    }
    skipped
}

pub fn rows() -> Vec<Row> {
    [quick(), still(), moving()].into_iter().flatten().collect()
}

/// Two points that nearly coincide, and velocities that are lost in the middle of a run.
fn quick() -> Vec<Row> {
    let right = points::energy();
    let two = flow(&cavity_of(16, &[]), Some(points::doubled(1e-5)), open);
    let case = named("two points 1e-5 spacings apart");
    let mut rows = vec![Row::of_flow(case, Promise::Right(0.01), &two, Some(right))];
    let keys = ["output.report_every=10", "time.end=0.3"];
    let scene = Arc::new(Scene::build(&cavity_of(16, &keys)).expect("a scene"));
    let mut spoiled = Spoiled::new(open(&scene).expect("an engine"), scene.plan.moving(), 100, 5);
    let run = flow_on(&scene, &mut spoiled);
    rows.push(Row::of_flow(named("a velocity of NaN, once"), Promise::Mended, &run, None));
    for (name, changes) in KINDS {
        let scene = motion::scene(&column(&[changes, &["time.end=0.05"]].concat()), None).expect("a scene");
        let mut spoiled = Spoiled::new(open(&scene).expect("an engine"), scene.plan.moving(), 7, 10);
        let run = motion::moved_on(&scene, &mut spoiled);
        rows.push(motion::promised(named(&format!("{name}: a velocity of NaN, once")), Promise::Mended, run));
    }
    rows
}

/// Of points that move.
const KINDS: [(&str, &[&str]); 2] = [("shifted", &[]), ("MPS", MPS)];

fn named(case: &str) -> String {
    format!("on a GPU: {case}")
}

/// Points that stand.
fn still() -> Vec<Row> {
    let right = points::energy();
    let mut rows = Vec::new();
    let mut on = |case: &str, promise: Promise, changes: &[&str], cloud: Option<Cloud>| {
        let run = flow(&cavity_of(16, changes), cloud, open);
        rows.push(Row::of_flow(named(case), promise, &run, Some(right)));
    };
    on("two points 1e-3 spacings apart", Promise::Right(0.01), &[], Some(points::doubled(1e-3)));
    on("36 points in the square of 1 spacing", Promise::Right(0.01), &[], Some(points::cluster(6)));
    on("a ring of 8 neighbours gone", Promise::Right(0.01), &[], Some(points::around(1.5)));
    let jitter = ["cloud.arrangement=jittered", "cloud.jitter=0.49"];
    for (name, promise, changes) in [
        ("", Promise::Right(0.1), &[][..]),
        (", fitted faces", Promise::Right(0.1), &[FIT]),
        (", collocated", Promise::Bounded(1.0), &["effects.pressure.form=collocated", "method.radius=3.1"]),
        (", forward remap", Promise::Bounded(1.0), &["effects.advection.remap=forward"]),
    ] {
        on(&format!("jitter 0.49{name}"), promise, &[&jitter[..], changes].concat(), None);
    }
    on("50 spacings a step, jittered", Promise::Bounded(1.0), &[jitter[0], "time.courant=50"], None);
    on("a solve allowed 1 iteration", Promise::Right(0.001), &["effects.pressure.max_iterations=1"], None);
    let fast = [jitter[0], FIT, "effects.viscosity.kinematic=1e-6", "time.end=2.0"];
    on("Re 1e6 on 17 x 17 points, jittered, fitted faces", Promise::Bounded(1.0), &fast, None);
    on("density 1e38 kg/m^3", Promise::Flagged, &["fluid.density=1e38"], None);
    for (name, promise, retries) in [
        ("viscous number 10", Promise::Mended, "guard.retries=8"),
        ("viscous number 10, no retries", Promise::Flagged, "guard.retries=0"),
    ] {
        let run = flow(&time::viscous(10.0, &[retries]), None, open);
        rows.push(Row::of_flow(named(name), promise, &run, None));
    }
    let vortices = |changes: &[&str]| vortices(16, changes);
    let right = flow_of(&vortices(&["cloud.arrangement=regular"])).expect("vortices").energy();
    let across = flow(&vortices(&[&jitter[..], &[FIT]].concat()), None, open);
    let case = named("a periodic box, jitter 0.49, fitted faces");
    rows.push(Row::of_flow(case, Promise::Right(0.05), &across, Some(right)));
    for (name, metres) in [("micrometres", 1e-6), ("kilometres", 1e3)] {
        let case = named(&format!("a cavity in {name}, against metres"));
        rows.push(Row::of_error(case, 1e-3, points::scaled(metres, open)));
    }
    rows
}

fn moving() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, changes) in KINDS {
        let rough = if name == "MPS" { Kept::OrFlagged } else { Kept::Bounded };
        let of = |more: &[&str]| column(&[changes, &["time.end=0.1"], more].concat());
        let named = |case: &str| named(&format!("{name}: {case}"));
        let plain = of(&[]);
        for (apart, promise) in [(0.5, Kept::Bounded), (1e-3, rough)] {
            let run = motion::moved(&plain, Some(motion::doubled(&plain, apart)), open);
            rows.push(motion::kept(named(&format!("two points {apart:e} spacings apart")), promise, &run));
        }
        for (case, promise, more) in [
            ("a film of 4 spacings at rest", Kept::Bounded, &["cloud.fill.to=[0.3, 0.04]"][..]),
            ("jitter 0.45", rough, &["cloud.arrangement=jittered", "cloud.jitter=0.45"]),
        ] {
            rows.push(motion::kept(named(case), promise, &motion::moved(&of(more), None, open)));
        }
    }
    rows
}

#[test]
fn quick_ones_keep_their_promises_on_a_gpu() {
    if !left_out() {
        hold(&quick());
    }
}

#[test]
#[ignore = "half a minute"]
fn a_selection_keeps_its_promises_on_a_gpu() {
    if !left_out() {
        hold(&rows());
    }
}
