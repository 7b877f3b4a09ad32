//! Implicit viscosity: the velocity in the middle of the kick, and what it says of the pressure.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::pressure::Stop;
use crate::cpu::operations::{conservative, derivative, implicit_viscosity};
use crate::cpu::real::Real;
use crate::engine::{Clock, EngineError, Outcome};
use crate::step::{Buffer, Operation};
use crate::with_space;

impl<T: Real> CpuEngine<T> {
    pub(super) fn diffuse_velocity(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (interior, constants) = (scene.sizes.interior, &scene.constants);
        let diffusion = clock.kick * constants.viscosity;
        let kick_per_density = T::from_f64(clock.kick / constants.density);
        match operation {
            Operation::ImplicitViscosity => return self.solve_viscosity(T::from_f64(diffusion), clock),
            Operation::ImplicitKick => {
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let before = self.fields.real(Buffer::Projected)?;
                    implicit_viscosity::add_kick(self.fields.real(Buffer::Middle)?, before, interior, &mut kick);
                });
            }
            Operation::PredictImplicit => {
                with_taken!(self.fields, [predicted = Buffer::Projected], {
                    let (middle, kick) = (self.fields.real(Buffer::Middle)?, self.fields.real(Buffer::Kick)?);
                    let share = T::from_f64(scene.seen_share(clock.kick));
                    let mean = self.fields.real(Buffer::PressureKick)?;
                    implicit_viscosity::predict(middle, mean, kick, share, interior, &mut predicted);
                });
            }
            Operation::AddMeanPressure => {
                with_taken!(self.fields, [source = Buffer::Source, dilation = Buffer::Dilation], {
                    let share = T::from_f64(scene.seen_share(clock.kick));
                    let (matrix, mean) = (self.conservative()?, self.fields.real(Buffer::MeanPressure)?);
                    implicit_viscosity::add_mean_pressure(
                        matrix,
                        mean,
                        share,
                        -kick_per_density,
                        &mut source,
                        &mut dilation,
                    );
                });
            }
            Operation::RelaxPressure => {
                with_taken!(self.fields, [mean = Buffer::MeanPressure], {
                    let dynamic = T::from_f64(constants.density * constants.viscosity);
                    let (pressure, dilation) =
                        (self.fields.real(Buffer::Pressure)?, self.fields.real(Buffer::Dilation)?);
                    implicit_viscosity::relax_pressure(pressure, dilation, dynamic, &mut mean);
                });
            }
            Operation::MeanKickByFit => {
                with_taken!(self.fields, [kick = Buffer::PressureKick], {
                    kick.fill(T::zero());
                    let mean = self.fields.real(Buffer::MeanPressure)?;
                    derivative::correct_by_fit(self.gradient()?, mean, -kick_per_density, interior, &mut kick);
                });
            }
            _ => {
                with_taken!(self.fields, [kick = Buffer::PressureKick], {
                    kick.fill(T::zero());
                    with_space!(self.domain, space => conservative::correct_by_adjoint(
                        self.faces()?,
                        space,
                        self.standing(Buffer::Position)?,
                        self.fields.real(Buffer::Volume)?,
                        self.fields.real(Buffer::MeanPressure)?,
                        -kick_per_density,
                        interior,
                        &mut kick,
                    ));
                });
            }
        }
        Ok(())
    }

    fn solve_viscosity(&mut self, diffusion: T, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let stop = Stop {
            residual: scene.constants.viscous_tolerance / clock.dt,
            max_iterations: implicit_viscosity::MOST_ITERATIONS,
            floor: Stop::CONSERVATIVE_FLOOR,
            singular: false,
        };
        let solve = with_taken!(
            self.fields,
            [
                middle = Buffer::Middle,
                residual = Buffer::ViscousResidual,
                direction = Buffer::ViscousDirection,
                product = Buffer::ViscousProduct
            ],
            {
                let matrix = implicit_viscosity::Matrix {
                    faces: self.faces()?,
                    face_sum: self.fields.real(Buffer::Diagonal)?,
                    volume: self.fields.real(Buffer::Volume)?,
                    per_volume: &self.per_volume,
                    diffusion,
                    interior: scene.sizes.interior,
                };
                let before = self.fields.real(Buffer::Projected)?;
                let (residual, direction, product) = (&mut residual[..], &mut direction[..], &mut product[..]);
                let work = implicit_viscosity::Work { residual, direction, product };
                implicit_viscosity::solve(matrix, scene.sizes.points, before, stop, work, &mut middle)
            }
        );
        self.viscous_solve = solve;
        // Numbers that are none are found where the step's velocities are watched.
        match solve.outcome {
            Outcome::Stagnated => Err(EngineError::viscosity(&solve)),
            Outcome::Converged | Outcome::BrokeDown => Ok(()),
        }
    }
}
