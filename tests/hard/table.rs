//! Scenes at the edge of what the method can do: what is promised of each, and what was measured.
//!
//! `cargo test --test hard -- --ignored the_page` writes `docs/hard_cases.md`.

use std::fs;
use std::path::Path;

use stillpoint::simulation::{Stop, Trouble};

use crate::flow::Flow;
use crate::{
    ROOT, table_of_input, table_of_motion, table_of_points, table_of_pressure, table_of_shapes, table_of_time,
    table_on_gpu,
};

const INTRODUCTION: &str = "\
# Hard cases

Scenes at the edge of what the method can do: what is promised of each, and what was measured, by
`cargo test --test hard -- --ignored the_page`. The tests hold every row to its promise.

Unless a row says otherwise: a lid-driven cavity at Re 100, 1 x 1 m, 16 spacings a side, to t = 1 s, on the CPU in f64. The
error of a flow is that of its kinetic energy, against the same flow on undisturbed regular points; energies are over that of
the whole domain moving as fast as its walls. A promise is a bound that a fair method keeps, and no record of what this one
did: most errors are far below it.

The rows at the end are a selection on the GPU engine, in f32, by `cargo test --test hard -- --ignored a_selection`; four of them
run with every test. They were measured on Mesa's software adapter. Right is what the CPU finds in f64. The promises are those of
the CPU but for the solve that is allowed one iteration, where f32 has 1e-3 in place of 1e-9. The runs are shorter at Re 1e6, to 2 s,
and of points that move, to 0.1 s and 0.05 s. f32 holds no numbers above 3e38: what grows without bound stops a run by a figure
that is none before it does by its energy. What the guards of a run cost is in [prices.md](prices.md).
";

/// What is promised.
#[derive(Clone, Copy)]
pub enum Promise {
    /// The right answer, within a relative error.
    Right(f64),
    /// It runs to its end, its energy never above so many times that of the whole domain moving as fast as its walls.
    Bounded(f64),
    /// It goes on with shorter steps and ends well, and says so.
    Mended,
    /// It stops early, says why and where, and keeps its last good state.
    Flagged,
    /// It is not begun: one line with these words.
    Refused(&'static str),
}

/// One case.
pub struct Row {
    pub case: String,
    promise: String,
    measured: String,
    pass: bool,
}

impl Row {
    pub fn new(case: impl Into<String>, promise: impl Into<String>, measured: impl Into<String>, pass: bool) -> Self {
        Self { case: case.into(), promise: promise.into(), measured: measured.into(), pass }
    }

    /// Broken where `also` is false too.
    pub fn and(self, also: bool) -> Self {
        Self { pass: self.pass && also, ..self }
    }

    /// A flow, or why there was none, against what is promised. `expected` is the kinetic energy of the right answer, m^4/s^2.
    pub fn of_flow(
        case: impl Into<String>,
        promise: Promise,
        flow: &Result<Flow, String>,
        expected: Option<f64>,
    ) -> Self {
        let (words, measured, pass) = match (promise, flow) {
            (Promise::Refused(words), Err(said)) => {
                (format!("refused: {words}"), said.clone(), said.contains(words) && !said.contains('\n'))
            }
            (Promise::Refused(words), Ok(flow)) => (format!("refused: {words}"), flow.end(), false),
            (promise, Err(said)) => (promise.words(), said.clone(), false),
            (promise, Ok(flow)) => {
                let (measured, pass) = promise.of(flow, expected);
                // Points that do not hang together are told of.
                let told =
                    flow.outcome.warnings.iter().any(|warning| warning.contains("groups out of each other's sight"));
                let told = told == (flow.scene.groups > 1);
                (promise.words(), measured + &counted(flow), pass && told && flow.is_finite())
            }
        };
        Self::new(case, words, measured, pass)
    }

    /// An error against what is promised of it.
    pub fn of_error(case: impl Into<String>, most: f64, error: f64) -> Self {
        Self::new(case, Promise::Right(most).words(), format!("error {error:.1e}"), error <= most)
    }
}

impl Promise {
    fn words(self) -> String {
        match self {
            Promise::Right(within) => format!("right within {within:.0e}"),
            Promise::Bounded(most) => format!("energy at most {most} of the walls'"),
            Promise::Mended => "ends well with shorter steps, and says so".to_owned(),
            Promise::Flagged => "stops, says why, keeps its last good state".to_owned(),
            Promise::Refused(words) => format!("refused: {words}"),
        }
    }

    fn of(self, flow: &Flow, expected: Option<f64>) -> (String, bool) {
        // Points that move are given back their step in time: what was done is in the warnings.
        let halvings = flow.outcome.warnings.iter().filter(|warning| warning.contains("half the step")).count();
        match self {
            Promise::Right(within) => {
                let error = (flow.energy() / expected.unwrap_or(f64::NAN) - 1.0).abs();
                let measured = if flow.ended() { format!("error {error:.1e}") } else { flow.end() };
                (measured, flow.ended() && error <= within && halvings == 0)
            }
            Promise::Bounded(most) => {
                let found = flow.most_energy();
                let measured = if flow.ended() { format!("energy {found:.2e}") } else { flow.end() };
                (measured, flow.ended() && found <= most && halvings == 0)
            }
            Promise::Mended => {
                let measured =
                    format!("{}, {halvings} times half the step, energy {:.2e}", flow.end(), flow.most_energy());
                (measured, flow.ended() && halvings > 0 && flow.most_energy() <= 1.0)
            }
            _ => {
                let located = match &flow.outcome.stop {
                    Stop::Trouble {
                        trouble: Trouble::NonFinite { .. } | Trouble::Energy { .. } | Trouble::Figure { .. },
                        ..
                    } => flow.end().contains(" at ("),
                    Stop::Trouble { .. } => true,
                    _ => false,
                };
                (flow.end(), located)
            }
        }
    }
}

/// Second choices that the run took.
fn counted(flow: &Flow) -> String {
    let [widened, lowered, nearest] = flow.outcome.ladder;
    let counts = [
        (widened, "widened"),
        (lowered, "of lower order"),
        (nearest, "nearest"),
        (flow.outcome.fallbacks, "direct solves"),
    ];
    let groups = flow.scene.groups as u64;
    let counts = counts.into_iter().chain([(if groups > 1 { groups } else { 0 }, "groups")]);
    counts.filter(|(count, _)| *count > 0).map(|(count, what)| format!(", {count} {what}")).collect()
}

fn all() -> Vec<(&'static str, Vec<Row>)> {
    vec![
        ("Points", table_of_points::rows()),
        ("Time and viscosity", table_of_time::rows()),
        ("Pressure", table_of_pressure::rows()),
        ("Corners, and pressure given all around", table_of_shapes::rows()),
        ("Points that move", table_of_motion::rows()),
        ("Input", table_of_input::rows()),
    ]
}

#[test]
fn every_hard_case_keeps_its_promise_and_stands_on_the_page() {
    let rows: Vec<Row> = all().into_iter().flat_map(|(_, rows)| rows).collect();
    hold(&rows);
    assert!(rows.len() >= 60, "{} rows", rows.len());
}

/// Every row keeps its promise and stands on the page.
pub fn hold(rows: &[Row]) {
    let page = fs::read_to_string(Path::new(ROOT).join("docs/hard_cases.md")).unwrap_or_default();
    let broken: Vec<String> = rows
        .iter()
        .filter(|row| !row.pass)
        .map(|row| format!("\n{}: promised {}, measured {}", row.case, row.promise, row.measured))
        .collect();
    assert!(broken.is_empty(), "{}", broken.concat());
    let absent: Vec<&str> =
        rows.iter().map(|row| row.case.as_str()).filter(|case| !page.contains(&format!("| {case} |"))).collect();
    assert!(absent.is_empty(), "not on docs/hard_cases.md: {absent:?}");
}

#[test]
#[ignore = "writes docs/hard_cases.md"]
fn the_page() {
    let mut page = INTRODUCTION.to_owned();
    let (mut count, mut kept) = (0, 0);
    let on_gpu = if table_on_gpu::left_out() { Vec::new() } else { table_on_gpu::rows() };
    for (title, rows) in all().into_iter().chain([("On a GPU, in f32", on_gpu)]).filter(|(_, rows)| !rows.is_empty()) {
        page += &format!("\n## {title}\n\n| case | promise | measured | |\n|---|---|---|---|\n");
        for Row { case, promise, measured, pass } in rows {
            let verdict = if pass { "kept" } else { "BROKEN" };
            page += &format!("| {case} | {promise} | {} | {verdict} |\n", measured.replace('|', "/"));
            (count, kept) = (count + 1, kept + u32::from(pass));
        }
    }
    page += &format!("\n{kept} of {count} promises kept.\n");
    fs::write(Path::new(ROOT).join("docs/hard_cases.md"), page).expect("docs/");
    println!("{kept} of {count}");
}
