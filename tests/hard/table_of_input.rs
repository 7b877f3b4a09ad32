//! Hard cases of what is given: keys at the end of their ranges and beyond, fields that are no numbers, files that are none.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::output::checkpoint::Checkpoint;
use stillpoint::scene::Scene;
use stillpoint::step::Buffer;

use crate::cases::cavity_of;
use crate::flow::{Flow, flow_of, flow_on};
use crate::spoiled::Spoiled;
use crate::table::{Promise, Row};

const CAVITY: &str = "title = 'C'\ndomain = { width = 1.0, height = 1.0 }\nfluid.density = 1.0\n\
    cloud = { arrangement = 'regular', spacing = 0.0625 }\nboundaries.top.velocity = [1.0, 0.0]\n\
    effects = { viscosity = { kinematic = 0.01 }, pressure = {}, advection = {} }\ntime = { end = 1.0 }\n";

/// The cavity with keys that a case file might hold, right or wrong.
pub fn from_keys(changes: &[&str]) -> Result<Flow, String> {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    let case = Case::from_text(CAVITY, Path::new("c.toml"), &changes).map_err(|error| error.to_string())?;
    flow_of(&case)
}

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut refused = |case: &str, key: &str, words: &'static str| {
        rows.push(Row::of_flow(case, Promise::Refused(words), &from_keys(&[key]), None));
    };
    refused(
        "a width of infinity",
        "domain.width=inf",
        "domain.width = inf: must be a length above 0, m; it is not finite",
    );
    refused(
        "a spacing of NaN",
        "cloud.spacing=nan",
        "cloud.spacing = NaN: must be a length above 0, m; it is not finite",
    );
    refused("a spacing of 1e-9 m", "cloud.spacing=1e-9", "more than 1e8; take a larger spacing");
    refused("a spacing of 1e-320 m", "cloud.spacing=1e-320", "more than 1e8; take a larger spacing");
    refused("a negative density", "fluid.density=-1.0", "fluid.density = -1.0: must be a number above 0");
    refused("a viscosity of 0", "effects.viscosity.kinematic=0.0", "for none, leave out the table effects.viscosity");
    refused("a velocity of NaN", "boundaries.top.velocity=[nan, 0.0]", "boundaries.top.velocity[0] = NaN: must be");
    refused(
        "random points 1e-9 spacings apart",
        "cloud={ arrangement = 'random', spacing = 0.0625, minimum_distance = 1e-9 }",
        "must be a number from 0.1 to 0.75",
    );
    refused(
        "a seed of 1e30",
        "cloud={ arrangement = 'random', spacing = 0.0625, seed = 1e30 }",
        "cloud.seed = 1e30: must be a whole number from 0",
    );
    // Bodies.
    let ball = "{ circle = { centre = [0.5, 0.5], radius = 0.25 } }";
    for (case, part, words) in [
        (
            "an obstacle with a hole half a spacing wide",
            "{ circle = { centre = [0.5, 0.5], radius = 0.015 }, combine = 'subtract' }",
            "make several bodies, or one with a hole",
        ),
        (
            "an obstacle with a slit a third of a spacing wide",
            "{ box = { centre = [0.7, 0.5], size = [0.3, 0.02] }, combine = 'subtract' }",
            "another part of the boundary is too near",
        ),
        ("two bodies in one table", "{ circle = { centre = [0.9, 0.9], radius = 0.09 } }", "make several bodies"),
    ] {
        let key = format!("obstacles=[{{ name = 'it', parts = [{ball}, {part}] }}]");
        rows.push(Row::of_flow(case, Promise::Refused(words), &from_keys(&[&key]), None));
    }
    // Fields.
    for (name, value) in [("NaN", f64::NAN), ("infinity", f64::INFINITY), ("1e300 m/s", 1e300)] {
        for (precision, open) in [("", cpu::double as crate::flow::Open), (", f32", cpu::single)] {
            // What came from so far away is taken from the walls; in f32 the number is none.
            let swallowed = value == 1e300 && precision.is_empty();
            let promise = if swallowed { Promise::Bounded(1.0) } else { Promise::Flagged };
            rows.push(field(&format!("a velocity of {name} in the middle of a run{precision}"), promise, value, open));
        }
    }
    let scene = Arc::new(Scene::build(&cavity_of(16, &["output.report_every=10"])).expect("a scene"));
    let mut engine = Spoiled::new(cpu::double(&scene).expect("an engine"), scene.plan.moving(), 100, 5);
    let flow = flow_on(&scene, &mut engine);
    rows.push(Row::of_flow("a velocity of NaN, once", Promise::Mended, &flow, None));
    // Checkpoints.
    let file = |case: &str, bytes: &[u8], words: &'static str| {
        let said = Checkpoint::decode(bytes, Path::new("run/checkpoint"))
            .err()
            .map_or("read".to_owned(), |error| error.to_string());
        Row::new(
            case,
            format!("refused: {words}"),
            said.clone(),
            said.starts_with("run/checkpoint: ") && said.contains(words),
        )
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    crate::checkpoints::written(&path);
    let whole = std::fs::read(&path).expect("a file");
    let changed = |at: usize, to: u8| {
        let mut bytes = whole.clone();
        bytes[at] = to;
        bytes
    };
    rows.push(file("a checkpoint cut in half", &whole[..whole.len() / 2], "cut short"));
    rows.push(file(
        "a checkpoint with one bit altered",
        &changed(whole.len() - 9, whole[whole.len() - 9] ^ 1),
        "its checksum is another",
    ));
    rows.push(file("a checkpoint of a newer version", &changed(8, 9), "from a newer Stillpoint"));
    rows.push(file("an empty file for a checkpoint", &[], "not a checkpoint of Stillpoint"));
    rows.push(file("a picture for a checkpoint", b"\x89PNG\r\n\x1a\n and so on", "not a checkpoint of Stillpoint"));
    rows
}

/// The velocity of one point is spoiled in every try.
fn field(case: &str, promise: Promise, value: f64, open: crate::flow::Open) -> Row {
    struct Always {
        inner: Box<dyn stillpoint::engine::Engine>,
        buffer: Buffer,
        value: f64,
    }
    use stillpoint::engine::{Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, SolveInfo};
    impl Engine for Always {
        fn info(&self) -> EngineInfo {
            self.inner.info()
        }
        fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
            self.inner.write(buffer, data)
        }
        fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
            self.inner.read(buffer)
        }
        fn apply(&mut self, operation: stillpoint::step::Operation, clock: &Clock) -> Result<(), EngineError> {
            self.inner.apply(operation, clock)
        }
        fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
            if steps > 0
                && let Data::Real(mut values) = self.inner.read(self.buffer)?
            {
                values[200] = self.value;
                self.inner.write(self.buffer, &Data::Real(values))?;
            }
            self.inner.advance(steps, clock)
        }
        fn solve_info(&self) -> SolveInfo {
            self.inner.solve_info()
        }
        fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
            self.inner.measure(elapsed)
        }
    }
    let scene = Arc::new(Scene::build(&cavity_of(16, &["output.report_every=10"])).expect("a scene"));
    let mut engine = Always { inner: open(&scene).expect("an engine"), buffer: scene.plan.moving(), value };
    Row::of_flow(case, promise, &flow_on(&scene, &mut engine), None)
}
