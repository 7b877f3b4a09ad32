//! Points that move: particle steps a second of the collapsing column, at the counts that MPS-Basic was measured at: CPU seconds, but
//! by the clock on the wall where a hardware GPU computes.
//!
//! Prints a table in Markdown: `LP_NUM_THREADS=0 cargo bench --bench moving`; the variable keeps Mesa's software adapter on one core.
//! With arguments a table of one's own, a case, the end of the run in s, points along the column's breadth, then keys to set, among
//! them `engine=`, a part of an engine's name: `cargo bench --bench moving -- dam_break_mps 0.02 38,78 engine=gpu`. With `--operations`
//! it prints what each operation took as well, kernels compiled on the way.

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::{Gpu, GpuEngine, Precision, adapter};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Stop, simulate};

/// m
const BREADTH: f64 = 0.05715;
/// Step of MPS over the spacing, as in its case, s/m.
const STEP: f64 = 0.0005 / 0.0028575;
const END: f64 = 0.03;

/// Who computes.
#[derive(Clone, Copy)]
enum Computes {
    Cpu64,
    Cpu32,
    Gpu32,
}

impl Computes {
    const ALL: [Self; 3] = [Computes::Cpu64, Computes::Cpu32, Computes::Gpu32];

    fn name(self) -> &'static str {
        match self {
            Computes::Cpu64 => "cpu f64",
            Computes::Cpu32 => "cpu f32",
            Computes::Gpu32 => "gpu f32",
        }
    }

    fn open(self, scene: &Arc<Scene>, timed: bool) -> Result<Box<dyn Engine>, Box<dyn Error>> {
        match self {
            Computes::Cpu64 => Ok(cpu::double(scene)?),
            Computes::Cpu32 => Ok(cpu::single(scene)?),
            Computes::Gpu32 => {
                let open = if timed { Gpu::open_timed } else { Gpu::open };
                let gpu = open(&adapter::choose(None)?, Precision::Single)?;
                Ok(Box::new(GpuEngine::new(Arc::clone(scene), gpu)?))
            }
        }
    }
}

fn main() -> ExitCode {
    // Cargo adds --bench.
    let (flags, arguments): (Vec<_>, Vec<_>) = env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let operations = flags.iter().any(|flag| flag == "--operations");
    match table(&arguments, operations) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn table(arguments: &[String], operations: bool) -> Result<(), Box<dyn Error>> {
    ThreadPoolBuilder::new().num_threads(1).build_global()?;
    println!("| case | points | engine | steps | iterations a step | particle steps a second |");
    println!("|---|---|---|---|---|---|");
    let [case, end, counts, keys @ ..] = arguments else {
        for (case, counts) in [("dam_break_mps", [38, 78]), ("dam_break_shifted", [48, 88])] {
            for count in counts {
                for computes in Computes::ALL {
                    println!("{}", row(case, count, computes, END, &[], operations)?);
                }
            }
        }
        return Ok(());
    };
    let engines = keys.iter().find_map(|key| key.strip_prefix("engine="));
    let keys: Vec<String> = keys.iter().filter(|key| !key.starts_with("engine=")).cloned().collect();
    for count in counts.split(',') {
        for computes in
            Computes::ALL.into_iter().filter(|computes| engines.is_none_or(|name| computes.name().contains(name)))
        {
            println!("{}", row(case, count.parse()?, computes, end.parse()?, &keys, operations)?);
        }
    }
    Ok(())
}

/// The time between the first row of diagnostics after the beginning, when every kernel has been compiled, and the last.
#[derive(Default)]
struct Stretch {
    first: Option<(u64, ProcessTime, Instant)>,
    steps: u64,
    /// Of CPU, user and system, and by the clock on the wall, s.
    seconds: [f64; 2],
}

impl Observer for Stretch {
    fn report(&mut self, row: &Diagnostics) {
        if row.step == 0 {
            return;
        }
        let (step, busy, clock) = *self.first.get_or_insert_with(|| (row.step, ProcessTime::now(), Instant::now()));
        (self.steps, self.seconds) = (row.step - step, [busy.elapsed().as_secs_f64(), clock.elapsed().as_secs_f64()]);
    }

    fn stop_requested(&self) -> bool {
        false
    }
}

/// Runs one case. Measuring every tenth step counts too.
fn row(
    name: &str,
    count: u32,
    computes: Computes,
    end: f64,
    keys: &[String],
    operations: bool,
) -> Result<String, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).with_extension("toml");
    let spacing = BREADTH / f64::from(count);
    let mut set = vec![format!("cloud.spacing={spacing:?}"), format!("time.end={end:?}"), "expect={}".to_owned()];
    if name == "dam_break_mps" {
        set.push(format!("time.step={:?}", STEP * spacing));
    }
    set.extend_from_slice(keys);
    let scene = Arc::new(Scene::build(&Case::load(&path, &set)?)?);
    let mut engine = computes.open(&scene, operations)?;
    let mut stretch = Stretch::default();
    let outcome = simulate(&scene, engine.as_mut(), &mut stretch)?;
    if outcome.stop != Stop::End {
        return Err(format!("{name}: {:?}", outcome.stop).into());
    }
    let points = scene.sizes.points;
    // A GPU works while the CPU waits.
    let adapter = engine.info().adapter;
    let hardware = adapter.is_some_and(|adapter| !adapter.software);
    let rate = points as f64 * stretch.steps as f64 / stretch.seconds[usize::from(hardware)];
    let iterations = outcome.iterations as f64 / outcome.steps as f64;
    if operations {
        let mut spent: Vec<_> = engine.seconds().into_iter().collect();
        spent.sort_by(|a, b| b.1.total_cmp(&a.1));
        let micro = |seconds: f64| 1e6 * seconds / outcome.steps as f64;
        spent.iter().for_each(|(operation, seconds)| {
            eprintln!("  {:<28} {:>10.1} us a step", operation.name(), micro(*seconds))
        });
        eprintln!("  {:<28} {:>10.1} us a step, by the clock", "stepping", micro(outcome.stepping.as_secs_f64()));
    }
    Ok(format!("| {name} | {points} | {} | {} | {iterations:.0} | {rate:.2e} |", computes.name(), outcome.steps))
}
