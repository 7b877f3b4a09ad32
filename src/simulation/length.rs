//! How long a step may be.

use glam::DVec2;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Limit, Run, SimulationError};
use crate::case::{LONGEST_FORWARD, MOST_STEPS, MOVING_COURANT, Motion};
use crate::engine::{Clock, Data, EngineError};
use crate::step::{Buffer, Operation, Stage};

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

impl Run<'_> {
    /// The largest speed among the points from `first` on, m/s; where the spacing varies, of all the same motion in spacings, as
    /// if that were the largest.
    pub(super) fn fastest(&self, velocity: &[DVec2], first: usize) -> f64 {
        let cloud = &self.scene.cloud;
        let weighed = |point: usize| velocity[point].length() * (cloud.spacing / cloud.spacing_at(point));
        (first..velocity.len()).map(weighed).fold(0.0, f64::max)
    }

    /// The step from the limits of the effects present, so that a whole number of steps ends at `time.end`; halved so many
    /// times, and with what keeps it from being longer.
    pub(super) fn step(&mut self, speed: f64, now: f64, halvings: u32) -> Result<(Clock, Limit), SimulationError> {
        let (dt, longest, limit) = self.length(speed, now, halvings)?;
        let share = if self.scene.case.motion() == Motion::Shifted { self.share(longest, speed) } else { 1.0 };
        Ok((Clock { share, ..self.scene.clock(dt) }, limit))
    }

    /// That step, the longest one, and what keeps it from being longer.
    fn length(&mut self, speed: f64, now: f64, halvings: u32) -> Result<(f64, f64, Limit), SimulationError> {
        let time = &self.scene.case.time;
        let spacing = self.scene.constants.spacing;
        let forward = self.scene.plan.drift.contains(&Operation::RemapForward);
        let (longest, limit) = match time.step {
            Some(step) => (step, Limit::Fixed),
            None => {
                let courant = self.scene.case.courant();
                let limits = [
                    (self.limit, self.stable_by()),
                    (self.by_decay(), Limit::Viscosity),
                    (self.by_motion(courant, speed), Limit::Courant),
                    (self.by_fall(courant), Limit::Gravity),
                ];
                let shorter = |a: (f64, Limit), b: (f64, Limit)| if b.0 < a.0 { b } else { a };
                limits.into_iter().fold((f64::INFINITY, Limit::End), shorter)
            }
        };
        let longest = longest * 0.5_f64.powi(halvings as i32);
        let limit = if halvings > 0 { Limit::Guard } else { limit };
        let left = self.until(now) - now;
        if left <= 0.0 {
            return Ok((longest, longest, limit));
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
        Ok((dt, longest, limit))
    }

    /// The share of a step of the usual length, which moves no point by more than [`MOVING_COURANT`] spacings, that one of `longest` s is.
    fn share(&self, longest: f64, speed: f64) -> f64 {
        (longest / self.by_motion(MOVING_COURANT, speed).min(self.by_fall(MOVING_COURANT))).min(1.0)
    }

    /// The step in which nothing moves by more than `courant` spacings, s.
    fn by_motion(&self, courant: f64, speed: f64) -> f64 {
        let moves = self.scene.case.effects.advection.is_some() && speed > 0.0;
        if moves { courant * self.scene.constants.spacing / self.faster(speed, courant) } else { f64::INFINITY }
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

    /// The step in which gravity moves a point at rest by `courant` spacings, s.
    fn by_fall(&self, courant: f64) -> f64 {
        let (gravity, spacing) = (self.scene.constants.gravity.length(), self.scene.constants.spacing);
        match self.scene.case.effects.advection {
            // Beside the surface a point's fall and the pressure's answer follow each other as in the shortest wave.
            Some(_) if gravity > 0.0 && self.scene.plan.moves() => courant * (spacing / gravity).sqrt(),
            Some(_) if gravity > 0.0 => (2.0 * courant * spacing / gravity).sqrt(),
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

    /// Longest step that viscosity and diffusion allow, s.
    pub(super) fn stability_limit(&mut self) -> Result<f64, EngineError> {
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
        let clock = Clock { dt: unit, kick: unit, second_kick: 1.0, share: 1.0 };
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
}

/// Steps of at most `longest` that fill `left`, both in s: one rounding unit too many does not make one more.
pub(super) fn steps_in(left: f64, longest: f64) -> f64 {
    (left / longest * (1.0 - 1e-12)).ceil().max(1.0)
}
