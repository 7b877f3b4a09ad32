//! The steps from one row of diagnostics to the next.

use std::time::{Duration, Instant};

use super::length::steps_in;
use super::{Diagnostics, Limit, Progress, Run, SimulationError, State, Trouble, moving};
use crate::engine::{Clock, NonFinite};

/// Steps between two looks at the kinetic energy, where rows of diagnostics are further apart.
const WATCH_EVERY: u32 = 50;
/// Longest stretch of steps between two looks at the observer.
const STRETCH: Duration = Duration::from_millis(250);

/// How the steps of one row ended.
pub(super) enum Row {
    /// All of them done: the figures, and the state to go on from.
    Full(Diagnostics, State),
    Interrupted(Diagnostics),
    Trouble(Trouble),
}

impl Run<'_> {
    /// The first half kick, and the state after it.
    pub(super) fn begin(&mut self, speed: f64) -> Result<State, SimulationError> {
        let (clock, _) = self.step(speed, 0.0, 0)?;
        let dt = clock.dt;
        self.begin_steps(&clock)?;
        self.first_kick(&clock)?;
        self.first_pressure(&clock)?;
        let viscous = Some(self.limit).filter(|limit| limit.is_finite());
        let warnings = self.warnings.clone();
        let fallbacks = u64::from(self.engine.advance(0, &clock)?.fallbacks);
        let mut progress = Progress { dt, speed, viscous, fallbacks, warnings, ..Progress::default() };
        let mut good = State::read(self.scene, self.engine, &progress)?;
        self.look_at_points(&mut progress, &good)?;
        good.progress = progress;
        self.tell_moved();
        self.observer.keep(&good);
        Ok(good)
    }

    /// Chooses the length of the steps of the row to come.
    pub(super) fn next_step(&mut self, progress: &mut Progress) -> Result<(Clock, Limit), SimulationError> {
        let (next, limit) = self.step(progress.speed, progress.time, progress.halvings)?;
        self.change_step(next.dt / progress.dt)?;
        if next.dt != progress.dt {
            self.begin_steps(&next)?;
        }
        progress.dt = next.dt;
        Ok((next, limit))
    }

    /// The steps until the next row of diagnostics, and that row. `taken` counts the steps since `started`.
    pub(super) fn row(
        &mut self,
        progress: &mut Progress,
        (clock, limit): (Clock, Limit),
        started: &Instant,
        taken: &mut u64,
    ) -> Result<Row, SimulationError> {
        let dt = progress.dt;
        let longest = if self.scene.plan.moves() { moving::STRETCH } else { u32::MAX };
        let asked = self.scene.case.output.report_every.min(longest);
        let left = steps_in(self.until(progress.time) - progress.time, dt);
        let (row_start, mut done) = (progress.time, 0_u32);
        let count = (f64::from(asked)).min(left) as u32;
        let interrupted = loop {
            let some = stretch(count - done, started.elapsed(), *taken).min(WATCH_EVERY - done % WATCH_EVERY);
            let advance = match self.engine.advance(some, &clock) {
                Ok(advance) => advance,
                Err(error) => return Ok(Row::Trouble(Trouble::Engine(error))),
            };
            done += advance.steps;
            *taken += u64::from(advance.steps);
            progress.step += u64::from(advance.steps);
            // Not step by step: the time must not depend on how long the stretches were.
            progress.time = row_start + f64::from(done) * dt;
            progress.iterations += advance.iterations;
            progress.fallbacks += u64::from(advance.fallbacks);
            if let Some(field) = advance.trouble {
                return Ok(Row::Trouble(self.lost(field)));
            }
            if done >= count {
                break false;
            }
            if done % WATCH_EVERY == 0
                && let Some(trouble) = self.watch_energy()?
            {
                return Ok(Row::Trouble(trouble));
            }
            if self.observer.stop_requested() {
                break true;
            }
        };
        let measured = match self.engine.measure(progress.time - row_start) {
            Ok(measured) => measured,
            Err(error) => return Ok(Row::Trouble(Trouble::Engine(error))),
        };
        let solve = self.engine.solve_info();
        let mut row = Diagnostics {
            step: progress.step,
            time: progress.time,
            dt,
            kinetic_energy: measured.kinetic_energy,
            max_speed: measured.max_speed,
            divergence: measured.divergence,
            pressure_iterations: solve.iterations,
            residual: solve.last_residual * dt * clock.kick / self.scene.constants.density,
            change: measured.change,
            limit,
            viscous_iterations: self.engine.viscous_solve_info().map(|solve| solve.iterations),
            probes: Vec::new(),
        };
        if let Some(trouble) = self.watch(&row)? {
            return Ok(Row::Trouble(trouble));
        }
        // All that is still to be looked at is in the state, and comes to the host once.
        let mut state = std::mem::take(&mut self.spare);
        let lost = state.renew(self.scene, self.engine)?;
        if let Some(trouble) = self.look_at_points(progress, &state)? {
            self.spare = state;
            return Ok(Row::Trouble(trouble));
        }
        let graded = self.scene.cloud.local.is_some();
        let seen = graded || !self.probes.is_empty();
        let snapshot = seen.then(|| self.snapshot_of(&state, progress.time)).transpose()?;
        if let Some(snapshot) = &snapshot {
            row.probes = self.probes.iter().map(|probe| probe.value(snapshot)).collect();
        }
        if interrupted {
            self.spare = state;
            return Ok(Row::Interrupted(row));
        }
        progress.speed = self.wall_speed.max(row.max_speed);
        let steady = self.scene.case.time.steady.is_some_and(|least| row.change < least);
        if self.scene.plan.moves() {
            progress.calm();
        }
        progress.steady_rows = if steady { progress.steady_rows + 1 } else { 0 };
        progress.warnings.clone_from(&self.warnings);
        if let Some(snapshot) = snapshot.filter(|_| graded) {
            // Where the spacing varies the step goes by the motion in spacings.
            progress.speed = self.wall_speed.max(self.fastest(&snapshot.velocity, 0));
        }
        if let Some(field) = lost {
            self.spare = state;
            return Ok(Row::Trouble(self.lost(field)));
        }
        state.progress.clone_from(progress);
        Ok(Row::Full(row, state))
    }

    fn lost(&self, field: NonFinite) -> Trouble {
        let place = self.scene.cloud.position[field.point.min(self.scene.cloud.len() - 1)];
        Trouble::NonFinite { field, place }
    }
}

/// Steps to take before the observer is asked again: one to learn the pace, then as many as fit into [`STRETCH`].
fn stretch(left: u32, elapsed: Duration, steps: u64) -> u32 {
    if steps == 0 {
        return 1;
    }
    let pace = elapsed.as_secs_f64() / steps as f64;
    (STRETCH.as_secs_f64() / pace.max(1e-9)).clamp(1.0, f64::from(left)) as u32
}
