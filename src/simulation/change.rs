//! What is done where the length of a step changes, and before the first.

use glam::DVec2;

use super::Run;
use crate::case::Splitting;
use crate::engine::{Clock, Data, EngineError};
use crate::step::{Buffer, Operation};

/// Steps whose lengths differ by less, relative, are equally long: that much rounding makes of them.
const SAME_STEP: f64 = 1e-9;

impl Run<'_> {
    /// What depends on the length of a step, before the first one of it.
    pub(super) fn begin_steps(&mut self, clock: &Clock) -> Result<(), EngineError> {
        self.scene.plan.on_step.iter().try_for_each(|&operation| self.engine.apply(operation, clock))
    }

    /// Of a reflection the first half kick alone: after it, drift and whole kick follow each other. A projection begins with the
    /// drift, so that at every time as many kicks are done as drifts.
    pub(super) fn first_kick(&mut self, clock: &Clock) -> Result<(), EngineError> {
        // What implicit viscosity begins from.
        let mean = [Operation::MeanKickByFit, Operation::MeanKickByAdjoint];
        for &operation in self.scene.plan.kick.iter().filter(|operation| mean.contains(operation)) {
            self.engine.apply(operation, clock)?;
        }
        if self.scene.plan.splitting == Splitting::Projection {
            return Ok(());
        }
        let clock = Clock { second_kick: 0.0, ..*clock };
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
    pub(super) fn change_step(&mut self, ratio: f64) -> Result<(), EngineError> {
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
}
