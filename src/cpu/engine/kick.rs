//! The kick, the pressure's solve apart.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::open_sides::Open;
use crate::cpu::operations::{conservative, derivative, drag, gravity, kick, open_sides};
use crate::cpu::real::Real;
use crate::engine::{Clock, EngineError};
use crate::step::{Buffer, Operation};
use crate::with_space;

impl<T: Real> CpuEngine<T> {
    pub(super) fn kick(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let kick_per_density = T::from_f64(clock.kick / constants.density);
        match operation {
            Operation::ClearKick => {
                with_taken!(self.fields, [kick = Buffer::Kick], kick.fill(T::zero()));
            }
            Operation::Gravity => {
                let change = (clock.kick * constants.gravity).to_array().map(T::from_f64);
                with_taken!(self.fields, [kick = Buffer::Kick], gravity::gravity(change, &mut kick));
            }
            Operation::EstimateMiddle => {
                with_taken!(self.fields, [middle = Buffer::Projected, kick = Buffer::Kick], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    kick::estimate_middle(velocity, self.fields.real(Buffer::PressureKick)?, &mut middle, &mut kick);
                });
            }
            Operation::Viscosity(stage) => {
                let diffusion = T::from_f64(clock.kick * constants.viscosity);
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let field = self.fields.real(stage.velocity())?;
                    derivative::viscosity(self.laplacian()?, field, diffusion, self.forced(), &mut kick);
                });
            }
            Operation::Drag => {
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let (velocity, mean) =
                        (self.fields.real(Buffer::Velocity)?, self.fields.real(Buffer::PressureKick));
                    let resistance = self.fields.real(Buffer::Resistance)?;
                    let (inertia, time) = (T::from_f64(constants.drag_inertia), T::from_f64(clock.kick));
                    let body = drag::Body { resistance, inertia, time, interior: sizes.interior };
                    drag::drag(body, velocity, mean.ok(), &mut kick);
                });
            }
            Operation::Predict => {
                with_taken!(self.fields, [predicted = Buffer::Projected], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    kick::predict(velocity, self.fields.real(Buffer::Kick)?, &mut predicted);
                });
            }
            Operation::CorrectByFit => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    let pressure = self.fields.real(Buffer::Pressure)?;
                    let end = sizes.interior;
                    derivative::correct_by_fit(self.gradient()?, pressure, kick_per_density, end, &mut projected);
                });
            }
            Operation::CorrectByAdjoint => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    with_space!(self.domain, space => conservative::correct_by_adjoint(
                        self.faces()?,
                        space,
                        self.standing(Buffer::Position)?,
                        self.fields.real(Buffer::Volume)?,
                        self.fields.real(Buffer::Pressure)?,
                        kick_per_density,
                        sizes.interior,
                        &mut projected,
                    ));
                });
            }
            Operation::OpenSides(kicked) => {
                with_taken!(self.fields, [velocity = kicked.velocity()], {
                    let open = Open {
                        points: self.fields.index(Buffer::OpenPoints)?,
                        row: self.fields.real(Buffer::OpenRow)?,
                        count: self.fields.index(Buffer::OpenCount)?,
                        normal: self.fields.real(Buffer::OpenNormal)?,
                        capacity: sizes.open_capacity,
                    };
                    open_sides::open_sides(open, sizes.interior, sizes.points, &mut velocity);
                });
            }
            Operation::HoldWalls => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    let walls = 2 * sizes.interior..;
                    projected[walls.clone()].copy_from_slice(&self.fields.real(Buffer::Velocity)?[walls]);
                });
            }
            _ => {
                let second = T::from_f64(clock.second_kick);
                with_taken!(self.fields, [mean = Buffer::PressureKick, reflected = Buffer::Reflected], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    let (middle, kick) = (self.fields.real(Buffer::Projected)?, self.fields.real(Buffer::Kick)?);
                    kick::reflect(velocity, middle, kick, second, sizes.interior, &mut mean, &mut reflected);
                });
            }
        }
        Ok(())
    }
}
