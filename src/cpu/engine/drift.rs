//! The drift: the velocity carried along the flow.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::{fits, remap};
use crate::cpu::real::Real;
use crate::engine::{Clock, EngineError};
use crate::step::{Buffer, Operation, Points};
use crate::{with_order, with_space};

impl<T: Real> CpuEngine<T> {
    pub(super) fn drift(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let dt = T::from_f64(clock.dt);
        let moving = scene.plan.moving();
        match operation {
            Operation::FitVelocity(points) => {
                with_taken!(self.fields, [coefficients = Buffer::Coefficients], {
                    let values = self.fields.real(moving)?;
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] =>
                        fits::fit_velocity(self.fits::<_, N, F>(points, space)?, values, &mut coefficients)));
                });
            }
            Operation::MovePoints => {
                let place = Buffer::Position(Points::Moved);
                with_taken!(self.fields, [moved = place], {
                    let (standing, velocity) = (self.standing(Buffer::Position)?, self.fields.real(moving)?);
                    with_space!(self.domain, space =>
                        remap::move_points(space, standing, velocity, dt, sizes.interior, &mut moved));
                });
            }
            Operation::RemapForward => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => remap::remap_forward::<T, _, N>(
                        space,
                        self.standing(Buffer::Position)?,
                        self.fields.real(Buffer::Position(Points::Moved))?,
                        self.fields.real(Buffer::Support(Points::Moved))?,
                        self.fields.real(moving)?,
                        self.fields.real(Buffer::Coefficients)?,
                        sizes.interior,
                        &mut velocity,
                    )));
                });
            }
            Operation::KeepVelocity => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    velocity.copy_from_slice(self.fields.real(moving)?);
                });
            }
            _ => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    let around = self.around()?;
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => remap::remap_departure::<T, _, N>(
                        self.moving(space)?, around, dt, sizes.interior, &mut velocity)));
                });
            }
        }
        Ok(())
    }
}
