//! One run: steps until the end, a steady state, a request to stop, or trouble.

mod prices;

use std::time::{Duration, Instant};

use glam::DVec2;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::{Deserialize, Serialize};

use crate::case::LONGEST_FORWARD;
use crate::case::Splitting;
use crate::engine::{Clock, Data, Engine, EngineError, NonFinite};
use crate::known::Known;
use crate::motion;
use crate::scene::Scene;
use crate::snapshot::{Derivatives, Snapshot};
use crate::step::{Buffer, Operation, Points, Rung, Stage};

pub use prices::{Prices, prices};

/// One row of `diagnostics.csv`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
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
    /// Points that move: the motion is no longer one of the fluid.
    Diverged { reason: String, step: u64 },
    /// A field turned non-finite in the steps that ended with this one.
    NonFinite { field: NonFinite, place: DVec2, step: u64 },
}

/// What a run gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub stop: Stop,
    pub steps: u64,
    /// The fields at the end; after trouble, at the last row of diagnostics before it.
    pub snapshot: Snapshot,
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
    #[error(
        "time.step = {step}: at {speed} m/s points move {courant:.2} spacings a step; \
         allowed with the forward remap: at most 1"
    )]
    TooFastForForward { step: f64, speed: f64, courant: f64 },
    #[error("{field} of point {point} at ({x}, {y}) m is not finite: its numbers are beyond those of the precision")]
    NotFinite { field: String, point: usize, x: f64, y: f64 },
}

/// The first value of a snapshot that is no finite number: its column and its point.
fn not_finite(snapshot: &Snapshot) -> Option<(&str, usize)> {
    let columns = snapshot.columns();
    columns.iter().find_map(|column| {
        let found = |point| column.at(point).find(|(_, value)| !value.is_finite()).map(|(name, _)| (name, point));
        (0..column.len()).find_map(found)
    })
}

/// Most steps of points that move between two looks at their speed.
const MOVING_STRETCH: u32 = 10;
/// `nu dt / l0^2` of points that move.
const MOVING_DIFFUSION: f64 = 0.1;
/// Longest stretch of steps between two looks at the observer.
const STRETCH: Duration = Duration::from_millis(250);
/// Share of the stability limit of viscosity and diffusion that a step uses.
const STABLE_SHARE: f64 = 0.8;
/// Applications of the viscous operator in the search for its largest eigenvalue.
const POWER_ITERATIONS: usize = 24;

/// Runs `scene` on `engine`, whose arrays hold what [`Scene::initial`] says.
pub fn simulate(
    scene: &Scene,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
) -> Result<Outcome, SimulationError> {
    let (limit, warnings, watch) = (f64::INFINITY, Vec::new(), Watch::new(scene));
    Run { scene, engine, observer, limit, warnings, watch }.run()
}

struct Run<'a> {
    scene: &'a Scene,
    engine: &'a mut dyn Engine,
    observer: &'a mut dyn Observer,
    /// Longest step that viscosity and diffusion allow, s.
    limit: f64,
    warnings: Vec<String>,
    watch: Watch,
}

impl Run<'_> {
    fn run(mut self) -> Result<Outcome, SimulationError> {
        let started = Instant::now();
        let any = self.scene.clock(1.0);
        for &operation in &self.scene.plan.setup {
            self.engine.apply(operation, &any)?;
        }
        self.limit = self.stability_limit()?;
        let ladder = self.ladder()?;
        let setup = started.elapsed();
        if !self.scene.plan.flows {
            return self.once(ladder, setup);
        }

        let started = Instant::now();
        let time = &self.scene.case.time;
        let begun = self.scene.initial_velocity();
        let fastest = |velocity: &[DVec2]| velocity.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
        let wall_speed = fastest(&begun[self.scene.sizes.interior..]);
        let mut dt = self.step(fastest(&begun), 0.0)?;
        self.begin_steps(dt)?;
        self.first_kick(dt)?;
        let mut good = self.snapshot(0.0)?;
        let every = self.scene.case.output.frame_every.unwrap_or(f64::INFINITY);
        let mut frame = every;
        if self.scene.plan.moves() {
            let (snapshot, moved) = self.moved(0, 0.0)?;
            self.watch.judge(&moved);
            self.observer.moved(&moved);
            if every.is_finite() {
                self.observer.frame(&snapshot);
            }
        }
        let (mut step, mut now, mut steady_rows) = (0_u64, 0.0, 0);
        let (mut fallbacks, mut iterations) = (0, 0);
        let stop = loop {
            if now >= time.end * (1.0 - 1e-12) {
                break Stop::End;
            }
            let moves = self.scene.plan.moves();
            let asked = self.scene.case.output.report_every.min(if moves { MOVING_STRETCH } else { u32::MAX });
            let left = steps_in(time.end.min(frame) - now, dt);
            let (row_start, mut done) = (now, 0_u32);
            let mut trouble = None;
            let count = (f64::from(asked)).min(left) as u32;
            let interrupted = loop {
                let clock = self.scene.clock(dt);
                let some = stretch(count - done, started.elapsed(), step);
                let advance = match self.engine.advance(some, &clock) {
                    // Points that move may cluster: the run ends, and what was good is kept.
                    Err(error @ EngineError::NeighbourOverflow { .. }) if moves => break Err(error.to_string()),
                    result => result?,
                };
                done += advance.steps;
                step += u64::from(advance.steps);
                // Not step by step: the time must not depend on how long the stretches were.
                now = row_start + f64::from(done) * dt;
                iterations += advance.iterations;
                fallbacks += u64::from(advance.fallbacks);
                if let Some(field) = advance.trouble {
                    trouble = Some(field);
                    break Ok(false);
                }
                if done >= count {
                    break Ok(false);
                }
                if self.observer.stop_requested() {
                    break Ok(true);
                }
            };
            if let Some(field) = trouble {
                let place = self.scene.cloud.position[field.point.min(self.scene.cloud.len() - 1)];
                break Stop::NonFinite { field, place, step };
            }
            let interrupted = match interrupted {
                Ok(interrupted) => interrupted,
                Err(reason) => break Stop::Diverged { reason, step },
            };
            let measured = self.engine.measure(now - row_start)?;
            let solve = self.engine.solve_info();
            let row = Diagnostics {
                step,
                time: now,
                dt,
                kinetic_energy: measured.kinetic_energy,
                max_speed: measured.max_speed,
                divergence: measured.divergence,
                pressure_iterations: solve.iterations,
                residual: solve.last_residual * dt * self.scene.clock(dt).kick / self.scene.constants.density,
                change: measured.change,
            };
            if moves {
                let (snapshot, moved) = self.moved(step, now)?;
                if let Some(reason) = self.watch.judge(&moved) {
                    break Stop::Diverged { reason, step };
                }
                good = snapshot;
                self.observer.report(&row);
                self.observer.moved(&moved);
                if now >= frame * (1.0 - 1e-12) {
                    self.observer.frame(&good);
                    frame += every;
                }
            } else {
                self.observer.report(&row);
                good = self.snapshot(now)?;
            }
            if interrupted || self.observer.stop_requested() {
                break Stop::Interrupted;
            }
            steady_rows = if time.steady.is_some_and(|least| row.change < least) { steady_rows + 1 } else { 0 };
            if steady_rows == STEADY_ROWS {
                break Stop::Steady;
            }
            let next = self.step(wall_speed.max(row.max_speed), now)?;
            self.change_step(next / dt)?;
            if next != dt {
                self.begin_steps(next)?;
            }
            dt = next;
        };
        let stepping = started.elapsed();
        let warnings = self.warnings;
        Ok(Outcome { stop, steps: step, snapshot: good, fallbacks, iterations, ladder, setup, stepping, warnings })
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
        Ok(Outcome { stop: Stop::End, steps: 0, snapshot, fallbacks, iterations, ladder, setup, stepping, warnings })
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

    /// The step from the limits of the effects present, so that a whole number of steps ends at `time.end`.
    fn step(&mut self, speed: f64, now: f64) -> Result<f64, SimulationError> {
        let time = &self.scene.case.time;
        let spacing = self.scene.constants.spacing;
        let forward = self.scene.plan.drift.contains(&Operation::RemapForward);
        let longest = time.step.unwrap_or_else(|| {
            let moves = self.scene.case.effects.advection.is_some() && speed > 0.0;
            // Points that move fall on until the next look at their speed.
            let falls = if self.scene.plan.moves() {
                self.scene.constants.gravity.length() * f64::from(MOVING_STRETCH)
            } else {
                0.0
            };
            let by_motion = match moves {
                true => {
                    2.0 * time.courant * spacing
                        / (speed + (speed * speed + 4.0 * falls * time.courant * spacing).sqrt())
                }
                false => f64::INFINITY,
            };
            by_motion.min(self.by_fall()).min(self.limit)
        });
        let until = match self.scene.case.output.frame_every {
            Some(every) if self.scene.plan.moves() => {
                time.end.min(every * ((now / every * (1.0 + 1e-9)).floor() + 1.0))
            }
            _ => time.end,
        };
        let left = until - now;
        if left <= 0.0 {
            return Ok(longest);
        }
        let dt = left / steps_in(left, longest);
        let courant = dt * speed / spacing;
        if forward && courant > LONGEST_FORWARD * (1.0 + 1e-9) {
            return Err(SimulationError::TooFastForForward { step: dt, speed, courant });
        }
        if dt > self.limit && self.warnings.is_empty() {
            let limit = self.limit;
            let diffuses = STABLE_SHARE * self.scene.constants.diffusion_limit <= limit;
            let name = if diffuses { "diffusion" } else { "viscosity" };
            self.warnings.push(format!("time.step = {dt:e} s is above the stability limit of the {name}, {limit:e} s"));
        }
        Ok(dt)
    }

    /// The step in which gravity moves a point at rest by `time.courant` spacings, s.
    fn by_fall(&self) -> f64 {
        let (gravity, spacing) = (self.scene.constants.gravity.length(), self.scene.constants.spacing);
        match self.scene.case.effects.advection {
            // Beside the surface a point's fall and the pressure's answer follow each other as in the shortest wave.
            Some(_) if gravity > 0.0 && self.scene.plan.moves() => {
                self.scene.case.time.courant * (spacing / gravity).sqrt()
            }
            Some(_) if gravity > 0.0 => (2.0 * self.scene.case.time.courant * spacing / gravity).sqrt(),
            _ => f64::INFINITY,
        }
    }

    /// What depends on the length of a step, before the first one of it.
    fn begin_steps(&mut self, dt: f64) -> Result<(), EngineError> {
        let clock = self.scene.clock(dt);
        self.scene.plan.on_step.iter().try_for_each(|&operation| self.engine.apply(operation, &clock))
    }

    /// Of a reflection the first half kick alone: after it, drift and whole kick follow each other. A projection begins with the
    /// drift, so that at every time as many kicks are done as drifts.
    fn first_kick(&mut self, dt: f64) -> Result<(), EngineError> {
        if self.scene.plan.splitting == Splitting::Projection {
            return Ok(());
        }
        let clock = Clock { second_kick: 0.0, ..self.scene.clock(dt) };
        let balance = clock.kick * self.scene.balanced_gravity();
        if balance != DVec2::ZERO {
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
        if self.scene.plan.splitting == Splitting::Projection || (ratio - 1.0).abs() < SAME_STEP {
            return Ok(());
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

    /// Largest stable step of the explicit viscous term, s, from the spectral radius of the operator by power iteration: on
    /// scattered points no formula knows it. Euler's step and the midpoint rule are stable up to `dt nu |lambda| = 2`.
    fn viscous_limit(&mut self) -> Result<f64, EngineError> {
        let Some(viscosity) = &self.scene.case.effects.viscosity else { return Ok(f64::INFINITY) };
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
        let clock = Clock { dt: 1.0, kick: 1.0, second_kick: 1.0 };
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
        Ok(STABLE_SHARE * 2.0 / radius)
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

    /// The state of points that move, and what is measured of it.
    fn moved(&mut self, step: u64, time: f64) -> Result<(Snapshot, motion::Row), EngineError> {
        let snapshot = self.snapshot(time)?;
        let pressured = self.scene.sizes.pressured;
        let mut index = |buffer: Buffer| match self.engine.read(buffer) {
            Ok(Data::Index(values)) => Ok(values[..snapshot.position.len()].to_vec()),
            Ok(Data::Real(_)) | Err(EngineError::Absent(_)) => Ok(Vec::new()),
            Err(error) => Err(error),
        };
        let (surface, rung) = (index(Buffer::Surface)?, index(Buffer::Rung(Points::Standing))?);
        let mut places = snapshot.position.clone();
        places.extend_from_slice(&self.scene.cloud.position[places.len()..pressured]);
        let pressure = match self.engine.read(Buffer::Pressure)? {
            Data::Real(values) => values[..pressured].to_vec(),
            Data::Index(_) => Vec::new(),
        };
        let state = motion::State {
            position: &snapshot.position,
            velocity: &snapshot.velocity,
            pressure: &pressure,
            pressured: &places,
            surface: &surface,
            rung: &rung,
        };
        let row = motion::measure(self.scene, &state, step, time, &mut self.watch.area);
        Ok((snapshot, row))
    }

    /// The fields as they are reported: the divergence-free velocity, the pressure relative to its mean.
    fn snapshot(&mut self, time: f64) -> Result<Snapshot, EngineError> {
        // Of points that move the fluid's alone: walls of points stand where they stood.
        let moves = self.scene.plan.moves();
        let points = if moves { self.scene.sizes.interior } else { self.scene.sizes.points };
        let mut velocity = vec![DVec2::ZERO; points];
        if self.scene.plan.flows
            && let Data::Real(values) = self.engine.read(Buffer::Projected)?
        {
            velocity = values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect();
        }
        let mut pressure = vec![0.0; points];
        if self.scene.plan.form.is_some()
            && let Data::Real(values) = self.engine.read(Buffer::Pressure)?
        {
            let singular = self.scene.constants.singular;
            let mean = if singular { values[..points].iter().sum::<f64>() / points as f64 } else { 0.0 };
            pressure = values[..points].iter().map(|p| p - mean).collect();
        }
        let mut carried = Vec::new();
        for &field in &self.scene.plan.carried {
            if let Data::Real(mut values) = self.engine.read(Buffer::Carried(field))? {
                values.truncate(points);
                carried.push((self.scene.case.field_name(field), values));
            }
        }
        let mut position = self.scene.cloud.position.clone();
        if moves && let Data::Real(values) = self.engine.read(Buffer::Position(Points::Standing))? {
            position = values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect();
        }
        Ok(Snapshot { time, position, velocity, pressure, carried, derivatives: None })
    }
}

/// Steps of at most `longest` that fill `left`, both in s: one rounding unit too many does not make one more.
fn steps_in(left: f64, longest: f64) -> f64 {
    (left / longest * (1.0 - 1e-12)).ceil().max(1.0)
}

/// Steps whose lengths differ by less, relative, are equally long: that much rounding makes of them.
const SAME_STEP: f64 = 1e-9;
/// Rows in a row that must be steady.
const STEADY_ROWS: u32 = 2;

/// Steps to take before the observer is asked again: one to learn the pace, then as many as fit into [`STRETCH`].
fn stretch(left: u32, elapsed: Duration, steps: u64) -> u32 {
    if steps == 0 {
        return 1;
    }
    let pace = elapsed.as_secs_f64() / steps as f64;
    (STRETCH.as_secs_f64() / pace.max(1e-9)).clamp(1.0, f64::from(left)) as u32
}

/// Watches points that move for a motion that is no longer one of the fluid.
struct Watch {
    /// Area that the fluid covered at the start, m^2; 0 before.
    area: f64,
    /// Energy at the start above that of all fluid on the floor, m^4/s^2.
    start: Option<f64>,
    /// Potential energy of all fluid on the floor, m^4/s^2.
    floor: f64,
}

/// Part by which the energy of a motion may exceed that at its start.
const ENERGY_GROWTH: f64 = 0.05;
/// Distance below which two points are one, in spacings.
const CLUMPED: f64 = 0.01;

impl Watch {
    fn new(scene: &Scene) -> Self {
        let (gravity, size) = (scene.constants.gravity, scene.constants.size);
        let volume = scene.cloud.filled.unwrap_or(0.0) * scene.cloud.interior as f64;
        let floor = -volume * gravity.max(DVec2::ZERO).dot(size);
        Self { area: 0.0, start: None, floor }
    }

    /// What is wrong, if something is.
    fn judge(&mut self, row: &motion::Row) -> Option<String> {
        let energy = row.kinetic_energy + row.potential_energy - self.floor;
        let start = *self.start.get_or_insert(energy);
        if row.nearest[0] < CLUMPED {
            return Some(format!("two points are {:.1e} spacings apart", row.nearest[0]));
        }
        (energy > (1.0 + ENERGY_GROWTH) * start)
            .then(|| format!("the energy has grown to {:.2} times that at the start", energy / start))
    }
}
