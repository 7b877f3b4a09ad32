//! A device that is too small, objects to a shader, or is gone: one line each, and no panic.

use std::sync::Arc;

use super::{Precision, candidate, made, scene};
use crate::engine::{Engine, EngineError};
use crate::gpu::device::{Gpu, explain};
use crate::gpu::{GpuEngine, launch};
use crate::simulation::{Diagnostics, Observer, Stop, Trouble, simulate};

fn one_line(error: &EngineError) -> String {
    let line = error.to_string();
    assert!(!line.contains('\n') && line.len() < 500, "{line:?}");
    line
}

#[test]
fn a_device_that_is_too_small_is_told_from_one_that_fails() {
    let Some(candidate) = candidate() else { return };
    let scene = Arc::new(scene(&[]));
    let refused = |shrink: &dyn Fn(&mut Gpu)| {
        let mut gpu = Gpu::open(&candidate, Precision::Single).expect("the adapter opens");
        shrink(&mut gpu);
        GpuEngine::new(Arc::clone(&scene), gpu).err().expect("a refusal")
    };
    let error = refused(&|gpu| gpu.limits.max_buffer_size = 1000);
    assert!(matches!(error, EngineError::TooLarge { allowed: 1000, .. }), "{error}");
    assert!(one_line(&error).ends_with("use fewer points or the CPU engine"), "{error}");
    let error = refused(&|gpu| gpu.limits.max_storage_buffers_per_shader_stage = 2);
    assert!(matches!(error, EngineError::Adapter(_)), "{error}");
    assert!(one_line(&error).ends_with("and the adapter allows 2; use the CPU engine"), "{error}");
}

#[test]
fn memory_that_runs_out_is_named() {
    let error = explain("velocity", &wgpu::Error::OutOfMemory { source: "full".into() });
    let expected = "the device has no memory left for velocity; use fewer points or the CPU engine";
    assert_eq!(one_line(&error), expected);
}

#[test]
fn a_shader_that_does_not_compile_is_named() {
    let Some(candidate) = candidate() else { return };
    let gpu = Gpu::open(&candidate, Precision::Single).expect("the adapter opens");
    let error = launch::built(&gpu, "nonsense", "@compute fn main( {", &[]).expect_err("nonsense");
    let line = one_line(&error);
    assert!(matches!(error, EngineError::Shader { .. }), "{line}");
    assert!(line.starts_with("GPU: the driver does not take the shader nonsense: nonsense: "), "{line}");
    // The device goes on after it.
    let sound = "@compute @workgroup_size(1) fn main() {}";
    launch::built(&gpu, "sound", sound, &[]).expect("a shader");
}

/// Takes the device away after a row.
struct Thief {
    device: wgpu::Device,
    rows: u32,
}

impl Observer for Thief {
    fn report(&mut self, _: &Diagnostics) {
        self.rows += 1;
        if self.rows == 2 {
            self.device.destroy();
        }
    }

    fn stop_requested(&self) -> bool {
        false
    }
}

#[test]
fn a_device_that_is_lost_ends_the_run_with_its_last_good_state() {
    let scene = Arc::new(scene(&["output.report_every=2"]));
    let Some(mut engine) = made(&scene, Precision::Single) else { return };
    let mut thief = Thief { device: engine.gpu().device.clone(), rows: 0 };
    let outcome = simulate(&scene, &mut engine, &mut thief).expect("an outcome");
    let Stop::Trouble { trouble: Trouble::Engine(error), .. } = &outcome.stop else { panic!("{:?}", outcome.stop) };
    assert!(one_line(error).starts_with("GPU: "), "{error}");
    assert_eq!(outcome.state.progress.step, 4);
    assert!(outcome.snapshot.velocity.iter().any(|u| u.length() > 0.1));
    assert!(engine.advance(1, &scene.clock(0.01)).is_err() && engine.info().engine == "gpu");
}
