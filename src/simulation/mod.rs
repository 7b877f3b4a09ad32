//! One run: steps until the end, a steady state, a request to stop, or trouble that shorter steps do not mend.

mod guard;
mod moving;
mod prices;
mod row;
mod state;

use std::time::{Duration, Instant};

use glam::DVec2;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::{Deserialize, Serialize};

use crate::case::Splitting;
use crate::case::{LONGEST_FORWARD, MOST_STEPS};
use crate::engine::{Clock, Data, Engine, EngineError};
use crate::known::Known;
use crate::measure::{MeasureError, Probe};
use crate::motion;
use crate::scene::Scene;
use crate::snapshot::{Derivatives, Snapshot};
use crate::step::{Buffer, Operation, Points, Rung, Stage};
pub use guard::{Limit, Trouble};
pub use prices::{Prices, prices};
use row::Row;
pub use state::{Motion, Progress, State};

/// One row of `diagnostics.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    pub step: u64,
    /// s
    pub time: f64,
    /// s
    pub dt: f64,
    /// Integral of `|u|^2 / 2` over the domain, m^4/s^2.
    pub kinetic_energy: f64,
    /// m/s
    pub max_speed: f64,
    /// Root mean square of `div u` over the points, 1/s.
    pub divergence: f64,
    /// Iterations of the pressure solve of this step.
    pub pressure_iterations: u32,
    /// Recomputed residual of the pressure solve of this step, as the volume change it leaves, `|div u| dt` (rms).
    pub residual: f64,
    /// Largest rate of change of a velocity since the last row, m/s^2.
    pub change: f64,
    /// What kept the step from being longer.
    pub limit: Limit,
    /// Iterations of the solve of implicit viscosity of this step; a column of its own where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_iterations: Option<u32>,
    /// Forces, differences and fluxes, in the order of [`Probe::of_case`]; columns of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<f64>,
}

/// Told of a run as it goes: draws the bar, writes the rows, asks it to stop.
pub trait Observer {
    /// A row of diagnostics is ready.
    fn report(&mut self, row: &Diagnostics);
    /// A row about points that move is ready.
    fn moved(&mut self, _: &motion::Row) {}
    /// A frame of points that move is to be kept.
    fn frame(&mut self, _: &Snapshot) {}
    /// True once the run is to stop after the steps it is in.
    fn stop_requested(&self) -> bool;
    /// The run can go on from here: at its beginning, and after each row that was reported.
    fn keep(&mut self, _: &State) {}
}

/// Watches nothing.
impl Observer for () {
    fn report(&mut self, _: &Diagnostics) {}

    fn stop_requested(&self) -> bool {
        false
    }
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// No velocity changed faster than `time.steady`.
    Steady,
    /// `time.end` was reached.
    End,
    /// The observer asked.
    Interrupted,
    /// Something went wrong in the steps that ended with this one, and again with every shorter step that was tried.
    Trouble { trouble: Trouble, step: u64 },
}

/// What a run gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub stop: Stop,
    pub steps: u64,
    /// The fields at the end; after trouble, at the last row of diagnostics before it.
    pub snapshot: Snapshot,
    /// What the run could go on from: its state at the last row of diagnostics that was asked for. Empty of a problem
    /// without time.
    pub state: State,
    /// Solves that were handed to the direct solver.
    pub fallbacks: u64,
    /// Pressure iterations of all steps.
    pub iterations: u64,
    /// Points whose fit was widened, is of a lower order, is the nearest value.
    pub ladder: [u64; 3],
    /// Wall-clock time of the setup operations, and of the steps with their reports.
    pub setup: Duration,
    pub stepping: Duration,
    pub warnings: Vec<String>,
}

/// Why a run could not be made or go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Measure(#[from] MeasureError),
    #[error(
        "time.step = {step}: at {speed} m/s points move {courant:.2} spacings a step; \
         allowed with the forward remap: at most 1"
    )]
    TooFastForForward { step: f64, speed: f64, courant: f64 },
    #[error("{field} of point {point} at ({x}, {y}) m is not finite: its numbers are beyond those of the precision")]
    NotFinite { field: String, point: usize, x: f64, y: f64 },
    #[error(
        "time.end = {end:e}: steps of at most {longest:e} s ({limit}) make more than {MOST_STEPS:e} of them; \
         allowed: a larger cloud.spacing, a smaller effects.viscosity.kinematic, or a sooner end"
    )]
    TooManySteps { end: f64, longest: f64, limit: Limit },
}

/// The first value of a snapshot that is no finite number: its column and its point.
fn not_finite(snapshot: &Snapshot) -> Option<(&str, usize)> {
    let columns = snapshot.columns();
    columns.iter().find_map(|column| {
        let found = |point| column.at(point).find(|(_, value)| !value.is_finite()).map(|(name, _)| (name, point));
        (0..column.len()).find_map(found)
    })
}

/// `nu dt / l0^2` of points that move.
const MOVING_DIFFUSION: f64 = 0.1;
/// Share of the stability limit of viscosity and diffusion that a step uses.
const STABLE_SHARE: f64 = 0.8;
/// Share of the decay of the slowest shear that a step with implicit viscosity takes.
const DECAY_SHARE: f64 = 0.1;
/// Divergence left by a pressure solve, over that of the walls' speed in a spacing, above which it shows in the flow.
const DOUBTFUL: f64 = 0.01;
/// Applications of the viscous operator in the search for its largest eigenvalue.
const POWER_ITERATIONS: usize = 24;

/// Runs `scene` on `engine`, whose arrays hold what [`Scene::initial`] says.
pub fn simulate(
    scene: &Scene,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
) -> Result<Outcome, SimulationError> {
    Run::new(scene, engine, observer).run(None)
}

/// Goes on with a run of `scene` from a state that it was in; the rest is as in [`simulate`], and so are the numbers, to the
/// last bit.
pub fn resume(
    scene: &Scene,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
    state: State,
) -> Result<Outcome, SimulationError> {
    Run::new(scene, engine, observer).run(Some(state))
}

struct Run<'a> {
    scene: &'a Scene,
    engine: &'a mut dyn Engine,
    observer: &'a mut dyn Observer,
    /// Longest step that viscosity and diffusion allow, s.
    limit: f64,
    /// m/s
    wall_speed: f64,
    /// Kinetic energy above which something is wrong, m^4/s^2.
    most_energy: f64,
    warnings: Vec<String>,
    moving: moving::Watch,
    /// Memory for the state of the next row.
    spare: State,
    /// Forces, differences and fluxes for the diagnostics.
    probes: Vec<Probe>,
}

impl<'a> Run<'a> {
    pub(super) fn new(scene: &'a Scene, engine: &'a mut dyn Engine, observer: &'a mut dyn Observer) -> Self {
        let (limit, warnings, moving) = (f64::INFINITY, Vec::new(), moving::Watch::new(scene));
        let (wall_speed, most_energy, probes) = (0.0, f64::MAX, Vec::new());
        let spare = State::default();
        Self { scene, engine, observer, limit, wall_speed, most_energy, warnings, moving, spare, probes }
    }

    fn run(mut self, resumed: Option<State>) -> Result<Outcome, SimulationError> {
        let started = Instant::now();
        let any = self.scene.clock(1.0);
        for &operation in &self.scene.plan.setup {
            self.engine.apply(operation, &any)?;
        }
        self.limit = match &resumed {
            Some(state) => state.progress.viscous.unwrap_or(f64::INFINITY),
            None => self.stability_limit()?,
        };
        let ladder = self.ladder()?;
        if self.scene.groups > 1 && resumed.is_none() {
            let groups = self.scene.groups;
            self.warnings.push(format!("the points fall into {groups} groups out of each other's sight"));
        }
        let setup = started.elapsed();
        if !self.scene.plan.flows {
            return self.once(ladder, setup);
        }

        let started = Instant::now();
        let time = &self.scene.case.time;
        let begun = self.scene.initial_velocity();
        self.most_energy = self.scene.energy_scale().map_or(f64::MAX, |scale| self.scene.case.guard.energy * scale);
        self.wall_speed = self.fastest(&begun, self.scene.sizes.interior);
        self.probes = Probe::of_case(&self.scene.case, &self.scene.cloud.position)?;
        let mut good = match resumed {
            Some(state) => {
                state.write(self.engine)?;
                self.begin_steps(state.progress.dt)?;
                self.warnings.clone_from(&state.progress.warnings);
                state
            }
            None => self.begin(self.fastest(&begun, 0))?,
        };
        let mut progress = good.progress.clone();
        let mut taken = 0;
        let (stop, snapshot) = loop {
            if progress.time >= time.end * (1.0 - 1e-12) {
                break (Stop::End, self.snapshot(progress.time)?);
            }
            if progress.steady_rows == STEADY_ROWS {
                break (Stop::Steady, self.snapshot(progress.time)?);
            }
            let limit = self.next_step(&mut progress);
            let row = limit.and_then(|limit| self.row(&mut progress, limit, &started, &mut taken));
            let step = progress.step;
            let interrupted = match row {
                Ok(Row::Full(row, state)) => {
                    self.observer.report(&row);
                    self.spare = std::mem::replace(&mut good, state);
                    self.tell_moved();
                    self.observer.keep(&good);
                    self.observer.stop_requested()
                }
                Ok(Row::Interrupted(row)) => {
                    self.observer.report(&row);
                    self.tell_moved();
                    true
                }
                Ok(Row::Trouble(trouble)) => {
                    if trouble.may_be_mended() && good.progress.halvings < self.scene.case.guard.retries {
                        progress = self.go_back(&mut good, &trouble, step)?;
                        continue;
                    }
                    break (Stop::Trouble { trouble, step }, self.snapshot_of(&good)?);
                }
                Err(error) if step == 0 && progress.halvings == 0 => return Err(error),
                Err(error) => {
                    let trouble = match error {
                        SimulationError::Engine(error) => Trouble::Engine(error),
                        error => Trouble::Refused(error.to_string()),
                    };
                    break (Stop::Trouble { trouble, step }, self.snapshot_of(&good)?);
                }
            };
            if interrupted {
                break (Stop::Interrupted, self.snapshot(progress.time)?);
            }
        };
        let stepping = started.elapsed();
        let warnings = self.warnings;
        let Progress { step: steps, fallbacks, iterations, .. } = match stop {
            Stop::Trouble { step, .. } => Progress { step, ..progress },
            _ => progress,
        };
        Ok(Outcome { stop, steps, snapshot, state: good, fallbacks, iterations, ladder, setup, stepping, warnings })
    }

    /// A problem without time: its operations, once.
    fn once(mut self, ladder: [u64; 3], setup: Duration) -> Result<Outcome, SimulationError> {
        let started = Instant::now();
        let clock = self.unit_clock();
        for &operation in &self.scene.plan.kick {
            self.engine.apply(operation, &clock)?;
        }
        let stepping = started.elapsed();
        let iterations = u64::from(self.engine.solve_info().iterations);
        let snapshot = match self.scene.plan.form {
            Some(_) => self.snapshot(0.0)?,
            None => self.derivatives()?,
        };
        if let Some((field, point)) = not_finite(&snapshot) {
            let place = self.scene.cloud.position[point];
            let field = field.to_owned();
            return Err(SimulationError::NotFinite { field, point, x: place.x, y: place.y });
        }
        let fallbacks = u64::from(self.engine.advance(0, &clock)?.fallbacks);
        let warnings = self.warnings;
        let (stop, state) = (Stop::End, State::default());
        Ok(Outcome { stop, steps: 0, snapshot, state, fallbacks, iterations, ladder, setup, stepping, warnings })
    }

    /// The clock by which the tolerance of a pressure solve is relative to the root mean square of its source.
    fn unit_clock(&self) -> Clock {
        let Some(known) = Known::of(&self.scene.case) else { return self.scene.clock(1.0) };
        let cloud = &self.scene.cloud;
        let square: f64 = cloud.position.iter().map(|&place| known.laplacian(place).powi(2)).sum();
        let rms = (square / cloud.len() as f64).sqrt();
        self.scene.clock((self.scene.constants.density / rms).sqrt())
    }

    /// What the operators made of a known field.
    fn derivatives(&mut self) -> Result<Snapshot, EngineError> {
        let points = self.scene.sizes.points;
        let mut read = |buffer: Buffer| match self.engine.read(buffer) {
            Ok(Data::Real(values)) => Ok(values),
            Ok(Data::Index(_)) | Err(EngineError::Absent(_)) => Ok(Vec::new()),
            Err(error) => Err(error),
        };
        let mut value = read(Buffer::FieldAverage)?;
        if value.is_empty() {
            value = read(Buffer::Field)?;
        }
        let mut laplacian = read(Buffer::FieldLaplacian)?;
        let gradient = read(Buffer::FieldGradient)?.chunks_exact(2).take(points).map(DVec2::from_slice).collect();
        value.truncate(points);
        laplacian.truncate(points);
        let derivatives = Some(Derivatives { value, gradient, laplacian });
        Ok(Snapshot { position: self.scene.cloud.position.clone(), derivatives, ..Snapshot::default() })
    }

    /// The largest speed among the points from `first` on, m/s; where the spacing varies, of all the same motion in spacings, as
    /// if that were the largest.
    fn fastest(&self, velocity: &[DVec2], first: usize) -> f64 {
        let cloud = &self.scene.cloud;
        let weighed = |point: usize| velocity[point].length() * (cloud.spacing / cloud.spacing_at(point));
        (first..velocity.len()).map(weighed).fold(0.0, f64::max)
    }

    /// The step from the limits of the effects present, so that a whole number of steps ends at `time.end`; halved so many
    /// times, and with what keeps it from being longer.
    fn step(&mut self, speed: f64, now: f64, halvings: u32) -> Result<(f64, Limit), SimulationError> {
        let time = &self.scene.case.time;
        let spacing = self.scene.constants.spacing;
        let forward = self.scene.plan.drift.contains(&Operation::RemapForward);
        let moves = self.scene.case.effects.advection.is_some() && speed > 0.0;
        let (longest, limit) = match time.step {
            Some(step) => (step, Limit::Fixed),
            None => {
                let courant = self.scene.case.courant();
                let by_motion = if moves { courant * spacing / self.faster(speed) } else { f64::INFINITY };
                let limits = [
                    (self.limit, self.stable_by()),
                    (self.by_decay(), Limit::Viscosity),
                    (by_motion, Limit::Courant),
                    (self.by_fall(), Limit::Gravity),
                ];
                let shorter = |a: (f64, Limit), b: (f64, Limit)| if b.0 < a.0 { b } else { a };
                limits.into_iter().fold((f64::INFINITY, Limit::End), shorter)
            }
        };
        let longest = longest * 0.5_f64.powi(halvings as i32);
        let limit = if halvings > 0 { Limit::Guard } else { limit };
        let left = self.until(now) - now;
        if left <= 0.0 {
            return Ok((longest, limit));
        }
        let dt = left / steps_in(left, longest);
        // Nor a step that is no number, or none.
        if left / dt > MOST_STEPS || dt.is_nan() || dt <= 0.0 {
            return Err(SimulationError::TooManySteps { end: time.end, longest, limit });
        }
        let courant = dt * speed / spacing;
        if forward && courant > LONGEST_FORWARD * (1.0 + 1e-9) {
            return Err(SimulationError::TooFastForForward { step: dt, speed, courant });
        }
        if dt > self.limit && !self.warnings.iter().any(|warning| warning.starts_with("time.step")) {
            let limit = self.limit;
            let name = self.stable_by();
            self.warnings.push(format!("time.step = {dt:e} s is above the stability limit of the {name}, {limit:e} s"));
        }
        self.doubt_tolerance(dt);
        Ok((dt, limit))
    }

    /// The tolerance is of the volume change in a step. Where steps are short beside the time in which the walls pass a spacing,
    /// it allows a divergence that the flow notices.
    fn doubt_tolerance(&mut self, dt: f64) {
        let tolerance = self.scene.constants.tolerance;
        let passed = dt * self.wall_speed / self.scene.constants.spacing;
        let doubted = self.warnings.iter().any(|warning| warning.starts_with("effects.pressure.tolerance"));
        if self.scene.plan.form.is_some() && passed > 0.0 && tolerance > DOUBTFUL * passed && !doubted {
            let (share, better) = (100.0 * tolerance / passed, 0.1 * DOUBTFUL * passed);
            self.warnings.push(format!(
                "effects.pressure.tolerance = {tolerance:e} allows a divergence of {share:.0}% of the walls' speed over a spacing \
                 in steps of {dt:.1e} s; try {better:.0e}"
            ));
        }
    }

    /// The step in which gravity moves a point at rest by `time.courant` spacings, s.
    fn by_fall(&self) -> f64 {
        let (gravity, spacing) = (self.scene.constants.gravity.length(), self.scene.constants.spacing);
        match self.scene.case.effects.advection {
            // Beside the surface a point's fall and the pressure's answer follow each other as in the shortest wave.
            Some(_) if gravity > 0.0 && self.scene.plan.moves() => {
                self.scene.case.courant() * (spacing / gravity).sqrt()
            }
            Some(_) if gravity > 0.0 => (2.0 * self.scene.case.courant() * spacing / gravity).sqrt(),
            _ => f64::INFINITY,
        }
    }

    /// Of implicit viscosity, which is stable in steps of any length, the share of the time in which it slows a shear between the
    /// nearer sides by a factor of e that a step may take, s.
    fn by_decay(&self) -> f64 {
        if !self.scene.case.implicit_viscosity() {
            return f64::INFINITY;
        }
        let across = self.scene.cloud.size.min_element() / std::f64::consts::PI;
        DECAY_SHARE * across.powi(2) / self.scene.constants.viscosity
    }

    /// What depends on the length of a step, before the first one of it.
    fn begin_steps(&mut self, dt: f64) -> Result<(), EngineError> {
        let clock = self.scene.clock(dt);
        self.scene.plan.on_step.iter().try_for_each(|&operation| self.engine.apply(operation, &clock))
    }

    /// Of a reflection the first half kick alone: after it, drift and whole kick follow each other. A projection begins with the
    /// drift, so that at every time as many kicks are done as drifts.
    fn first_kick(&mut self, dt: f64) -> Result<(), EngineError> {
        let clock = self.scene.clock(dt);
        // What implicit viscosity begins from.
        let mean = [Operation::MeanKickByFit, Operation::MeanKickByAdjoint];
        for &operation in self.scene.plan.kick.iter().filter(|operation| mean.contains(operation)) {
            self.engine.apply(operation, &clock)?;
        }
        if self.scene.plan.splitting == Splitting::Projection {
            return Ok(());
        }
        let clock = Clock { second_kick: 0.0, ..clock };
        let balance = clock.kick * self.scene.balanced_gravity();
        if self.scene.plan.form.is_some() && balance != DVec2::ZERO {
            let inside = vec![balance; self.scene.sizes.interior];
            self.engine.write(Buffer::PressureKick, &self.scene.vectors(&inside, DVec2::ZERO))?;
        }
        // A carried field has its half step before the first drift anyway.
        let forces = self
            .scene
            .plan
            .kick
            .iter()
            .filter(|operation| !matches!(operation, Operation::Diffuse(..) | Operation::HeatWalls(_)));
        for &operation in forces {
            self.engine.apply(operation, &clock)?;
        }
        Ok(())
    }

    /// Makes the second half of the last kick, `u' - u_m`, and the pressure's part in it `ratio` times as long: that of the step
    /// to come.
    fn change_step(&mut self, ratio: f64) -> Result<(), EngineError> {
        if (ratio - 1.0).abs() < SAME_STEP {
            return Ok(());
        }
        if self.scene.plan.splitting == Splitting::Projection {
            let keeps = self.scene.plan.buffers().contains(&Buffer::PressureKick);
            return if keeps { self.scale_pressure_kick(ratio) } else { Ok(()) };
        }
        let [middle, reflected] = [Buffer::Projected, Buffer::Reflected];
        if let (Data::Real(middle), Data::Real(mut end)) = (self.engine.read(middle)?, self.engine.read(reflected)?) {
            end.iter_mut().zip(middle).for_each(|(end, middle)| *end = middle + ratio * (*end - middle));
            self.engine.write(reflected, &Data::Real(end))?;
        }
        self.scale_pressure_kick(ratio)
    }

    fn scale_pressure_kick(&mut self, factor: f64) -> Result<(), EngineError> {
        if let Data::Real(mut mean) = self.engine.read(Buffer::PressureKick)? {
            mean.iter_mut().for_each(|mean| *mean *= factor);
            self.engine.write(Buffer::PressureKick, &Data::Real(mean))?;
        }
        Ok(())
    }

    /// Longest step that viscosity and diffusion allow, s.
    fn stability_limit(&mut self) -> Result<f64, EngineError> {
        Ok(self.viscous_limit()?.min(STABLE_SHARE * self.scene.constants.diffusion_limit))
    }

    /// Which of the two it is.
    fn stable_by(&self) -> Limit {
        let diffuses = STABLE_SHARE * self.scene.constants.diffusion_limit <= self.limit;
        if diffuses { Limit::Diffusion } else { Limit::Viscosity }
    }

    /// Largest stable step of the explicit viscous term, s, from the spectral radius of the operator by power iteration: on
    /// scattered points no formula knows it. Euler's step and the midpoint rule are stable up to `dt nu |lambda| = 2`.
    fn viscous_limit(&mut self) -> Result<f64, EngineError> {
        let Some(viscosity) =
            self.scene.case.effects.viscosity.as_ref().filter(|_| !self.scene.case.implicit_viscosity())
        else {
            return Ok(f64::INFINITY);
        };
        if self.scene.plan.moves() {
            // The arrangement changes: the bound of a lattice, with room.
            return Ok(MOVING_DIFFUSION * self.scene.constants.spacing.powi(2) / viscosity.kinematic);
        }
        let field = Buffer::Velocity;
        let interior = self.scene.sizes.interior;
        let kept = self.engine.read(field)?;
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
        let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        let mut trial = vec![DVec2::ZERO; interior];
        trial.iter_mut().for_each(|value| *value = DVec2::new(unit(), unit()));
        let mut radius = 0.0;
        // In the time that diffusion takes over a spacing the operator's numbers are near 1, whatever the units.
        let unit = self.scene.constants.spacing.powi(2) / self.scene.constants.viscosity;
        if !unit.is_finite() {
            return Ok(f64::INFINITY);
        }
        let clock = Clock { dt: unit, kick: unit, second_kick: 1.0 };
        for _ in 0..POWER_ITERATIONS {
            let norm = trial.iter().map(|value| value.length_squared()).sum::<f64>().sqrt();
            trial.iter_mut().for_each(|value| *value /= norm);
            self.engine.write(field, &self.scene.vectors(&trial, DVec2::ZERO))?;
            self.engine.write(Buffer::Kick, &self.scene.zeros(Buffer::Kick))?;
            self.engine.apply(Operation::Viscosity(Stage::Start), &clock)?;
            let Data::Real(result) = self.engine.read(Buffer::Kick)? else { break };
            trial = result[..2 * interior].chunks_exact(2).map(DVec2::from_slice).collect();
            radius = trial.iter().map(|value| value.length_squared()).sum::<f64>().sqrt();
        }
        self.engine.write(Buffer::Kick, &self.scene.zeros(Buffer::Kick))?;
        self.engine.write(field, &kept)?;
        Ok(STABLE_SHARE * 2.0 / radius * unit)
    }

    fn ladder(&mut self) -> Result<[u64; 3], EngineError> {
        let mut tally = [0; 3];
        let rung = Buffer::Rung(Points::Standing);
        if self.scene.plan.buffers().contains(&rung)
            && let Data::Index(rungs) = self.engine.read(rung)?
        {
            for &rung in rungs[..self.scene.sizes.points].iter().filter(|&&rung| rung > 0) {
                tally[match rung {
                    Rung::NEAREST => 2,
                    rung if rung > Rung::WIDER.len() as u32 => 1,
                    _ => 0,
                }] += 1;
            }
        }
        Ok(tally)
    }

    /// The fields as they are reported: the divergence-free velocity, the pressure relative to its mean.
    fn snapshot(&mut self, time: f64) -> Result<Snapshot, EngineError> {
        let Self { scene, engine, .. } = self;
        snapshot(scene, time, &mut |buffer| engine.read(buffer))
    }

    /// The same of a state, whatever has become of the engine since.
    fn snapshot_of(&self, state: &State) -> Result<Snapshot, EngineError> {
        let of = |buffer| state.array(buffer).cloned().ok_or(EngineError::Absent(buffer));
        snapshot(self.scene, state.progress.time, &mut |buffer| of(buffer))
    }
}

fn snapshot(
    scene: &Scene,
    time: f64,
    read: &mut dyn FnMut(Buffer) -> Result<Data, EngineError>,
) -> Result<Snapshot, EngineError> {
    // Of points that move the fluid's alone: walls of points stand where they stood.
    let moves = scene.plan.moves();
    let points = if moves { scene.sizes.interior } else { scene.sizes.points };
    let mut velocity = vec![DVec2::ZERO; points];
    if scene.plan.flows
        && let Data::Real(values) = read(Buffer::Projected)?
    {
        velocity = values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect();
    }
    let mut pressure = vec![0.0; points];
    if scene.plan.form.is_some()
        && let Data::Real(values) = read(Buffer::Pressure)?
    {
        let singular = scene.constants.singular;
        let mean = if singular { values[..points].iter().sum::<f64>() / points as f64 } else { 0.0 };
        pressure = values[..points].iter().map(|p| p - mean).collect();
    }
    let mut carried = Vec::new();
    for &field in &scene.plan.carried {
        if let Data::Real(mut values) = read(Buffer::Carried(field))? {
            values.truncate(points);
            carried.push((scene.case.field_name(field), values));
        }
    }
    let mut position = scene.cloud.position.clone();
    if moves && let Data::Real(values) = read(Buffer::Position(Points::Standing))? {
        position = values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect();
    }
    Ok(Snapshot { time, position, velocity, pressure, carried, derivatives: None })
}

/// Steps of at most `longest` that fill `left`, both in s: one rounding unit too many does not make one more.
fn steps_in(left: f64, longest: f64) -> f64 {
    (left / longest * (1.0 - 1e-12)).ceil().max(1.0)
}

/// Steps whose lengths differ by less, relative, are equally long: that much rounding makes of them.
const SAME_STEP: f64 = 1e-9;
/// Rows in a row that must be steady.
const STEADY_ROWS: u32 = 2;
