//! What the types of a case cannot say: ranges, and keys that do not go together. Every check names its key.

mod carried;
mod effects;
mod exact;
mod expectations;
mod layout;
mod moving;
mod obstacles;
mod sides;

use super::fault::Fault;
use super::{Case, Guard, Problem};

pub use effects::LONGEST_FORWARD;
pub(super) use expectations::check_profiles;
pub use layout::{LARGEST_CLOUD, LARGEST_RADIUS, SMALLEST_RADIUS, WIDEST_LADDER};

/// Most steps of one run: more would take years.
pub const MOST_STEPS: f64 = 1e9;

/// Most times that a run halves its step: a millionth of it is left then.
const MOST_RETRIES: u32 = 20;

/// The first thing wrong with a decoded case. Reads no file and allocates nothing that grows with the cloud.
pub(super) fn check(case: &Case) -> Result<(), Fault> {
    require(is_line(&case.title), "title")?;
    layout::check(case)?;
    moving::check(case)?;
    obstacles::check(case)?;
    effects::check(case)?;
    sides::check(case)?;
    carried::check(case)?;
    exact::check(case)?;
    if case.problem() == Problem::Flow {
        check_time(case)?;
    } else if case.guard != Guard::default() {
        return Err(Fault::reason("guard", "belongs to a flow, and this problem has no time; leave it out"));
    }
    require(case.guard.retries <= MOST_RETRIES, "guard.retries")?;
    require(case.guard.energy > 1.0, "guard.energy")?;
    require(case.output.report_every >= 1, "output.report_every")?;
    expectations::check(case)
}

fn check_time(case: &Case) -> Result<(), Fault> {
    let time = &case.time;
    require(time.end > 0.0, "time.end")?;
    require(case.courant() > 0.0 && case.courant() <= 50.0, "time.courant")?;
    require(time.steady.is_none_or(|change| change > 0.0), "time.steady")?;
    if time.steady.is_some() && !case.velocity_changes() {
        return Err(Fault::reason(
            "time.steady",
            "no effect changes the velocity, which is steady from the first; leave it out",
        ));
    }
    let Some(step) = time.step else { return Ok(()) };
    require(step > 0.0 && step <= time.end, "time.step")?;
    match time.end / step > MOST_STEPS {
        true => Err(Fault::reason("time.step", format!("more than {MOST_STEPS:e} steps until time.end"))),
        false => Ok(()),
    }
}

fn require(holds: bool, key: &str) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault::range(key)) }
}

/// One line that says something: titles and sources stand in pictures and summaries.
fn is_line(text: &str) -> bool {
    !text.trim().is_empty() && !text.contains(char::is_control)
}
