//! What the paper says of its two families of operators, on both engines: on jittered points more of them do not help the
//! integral form, while the error of the interpolation form falls at order 2.

use std::sync::Arc;

use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::Precision;
use stillpoint::known::Known;
use stillpoint::scene::Scene;
use stillpoint::simulation::simulate;

use crate::cases::problem;
use crate::engines::{candidate, gpu};

/// Relative rms error of the gradient over the points whose neighbourhood no wall cuts.
fn error(scene: &Arc<Scene>, engine: &mut dyn Engine) -> f64 {
    let known = Known::of(&scene.case).expect("a known field");
    let snapshot = simulate(scene, engine, &mut ()).expect("a run").snapshot;
    let found = snapshot.derivatives.expect("derivatives").gradient;
    let (mut off, mut size) = (0.0, 0.0);
    for (&place, gradient) in snapshot.position.iter().zip(found) {
        if place.min(1.0 - place).min_element() > scene.constants.radius {
            off += (gradient - known.gradient(place)).length_squared();
            size += known.gradient(place).length_squared();
        }
    }
    (off / size).sqrt()
}

#[test]
fn on_jittered_points_weighted_means_stay_wrong_and_fits_converge_at_order_two() {
    let Some(candidate) = candidate() else { return };
    for operators in ["integral", "interpolation"] {
        let [coarse, fine] = [24, 96].map(|n| {
            let operators = format!("method.operators={operators}");
            let case = problem(n, &["derivatives.field=waves", "cloud.jitter=0.4", &operators]);
            let scene = Arc::new(Scene::build(&case).expect("a scene"));
            let on_cpu = error(&scene, cpu::single(&scene).expect("an engine").as_mut());
            let on_gpu = error(&scene, &mut gpu(&candidate, &scene, Precision::Single));
            assert!((on_cpu - on_gpu).abs() < 0.01 * on_cpu, "{operators}, {n}: {on_cpu} and {on_gpu}");
            on_gpu
        });
        let order = (coarse / fine).log2() / 2.0;
        if operators == "integral" {
            assert!(order < 0.1 && fine > 0.1, "{coarse} to {fine}");
        } else {
            assert!(order > 1.9 && fine < 0.003, "{coarse} to {fine}");
        }
    }
}
