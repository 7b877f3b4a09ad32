//! A run of a hundred thousand steps: as much memory at its end as at its beginning, and as much energy.

use std::process::Command;
use std::sync::Arc;
use std::{env, fs};

use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, simulate};

use crate::cases::cavity_of;

/// Bytes that the process has in memory; 0 where the system does not say.
fn memory() -> usize {
    let pages = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    4096 * pages.split_whitespace().nth(1).and_then(|pages| pages.parse::<usize>().ok()).unwrap_or(0)
}

#[derive(Default)]
struct Watch(Vec<(Diagnostics, usize)>);

impl Observer for Watch {
    fn report(&mut self, row: &Diagnostics) {
        self.0.push((row.clone(), memory()));
    }

    fn stop_requested(&self) -> bool {
        false
    }
}

/// The cavity at Re 1000, once it is at rest, for so many steps.
fn soak(steps: u32) {
    let end = f64::from(steps) * 0.025;
    let keys = ["effects.viscosity.kinematic=1e-3", "time.step=0.025", "output.report_every=1000"];
    let end = format!("time.end={end:?}");
    let scene = Arc::new(Scene::build(&cavity_of(24, &[&keys[..], &[end.as_str()]].concat())).expect("a scene"));
    let mut watch = Watch::default();
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut watch).expect("a run");
    let rows = watch.0;
    assert_eq!((outcome.steps, rows.len()), (u64::from(steps), steps as usize / 1000));
    // From a tenth of the run on it is steady.
    let settled = &rows[rows.len() / 10..];
    let least = settled.iter().map(|(row, _)| row.kinetic_energy).fold(f64::INFINITY, f64::min);
    let most = settled.iter().map(|(row, _)| row.kinetic_energy).fold(0.0, f64::max);
    let (before, after) = (settled[0].1, settled[settled.len() - 1].1);
    println!(
        "{steps} steps on {} points: energy from {least:.9e} to {most:.9e} m^4/s^2, memory {:.1} MB, then {:.1} MB",
        scene.sizes.points,
        before as f64 / 1e6,
        after as f64 / 1e6
    );
    assert!(most / least - 1.0 < 1e-3, "the energy drifts: {least} to {most}");
    assert!(after <= before + (1 << 20), "the memory grows: {before} to {after} bytes");
}

const ALONE: &str = "STILLPOINT_SOAK_ALONE";

/// In a process of its own: in this one other tests take memory at the same time.
#[test]
#[ignore = "a minute"]
fn a_hundred_thousand_steps() {
    if env::var_os(ALONE).is_some() {
        return soak(100_000);
    }
    let arguments = ["--ignored", "--exact", "--nocapture", "soak::a_hundred_thousand_steps"];
    let mut own = Command::new(env::current_exe().expect("this program"));
    assert!(own.args(arguments).env(ALONE, "1").status().expect("a process").success());
}
