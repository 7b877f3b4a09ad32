//! The fields that the flow carries: brought along, diffused, and what their weight does.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::diffuse::Exchange;
use crate::cpu::operations::{buoyancy, carry, diffuse};
use crate::cpu::real::Real;
use crate::engine::{Clock, EngineError};
use crate::step::{Buffer, Carried, Operation, Points, Stage};
use crate::{with_order, with_space};

impl<T: Real> CpuEngine<T> {
    /// The fields that the flow carries along with the velocity.
    pub(super) fn carry(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, order) = (&scene.sizes, scene.constants.order);
        match operation {
            Operation::FindDepartures => {
                let mut nearest = self.fields.take_index(Buffer::DepartureNearest)?;
                with_taken!(self.fields, [departure = Buffer::Departure], {
                    let (around, dt) = (self.around()?, T::from_f64(clock.dt));
                    let normal = self.fields.real(Buffer::Normal)?;
                    with_space!(self.domain, space => with_order!(order, [N, F, M] => carry::find_departures::<T, _, N>(
                        self.moving(space)?, around, normal, dt, sizes.points, &mut departure, &mut nearest)));
                });
                self.fields.put_index(Buffer::DepartureNearest, nearest);
            }
            Operation::CarryVelocity => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    let departure = self.fields.real(Buffer::Departure)?;
                    let nearest = self.fields.index(Buffer::DepartureNearest)?;
                    with_space!(self.domain, space => with_order!(order, [N, F, M] => carry::carry_velocity::<T, _, N>(
                        self.moving(space)?, departure, nearest, sizes.interior, &mut velocity)));
                });
            }
            Operation::FitScalar(field) => {
                with_taken!(self.fields, [fitted = Buffer::ScalarFit], {
                    let values = self.fields.real(Buffer::Carried(field))?;
                    with_space!(self.domain, space => with_order!(order, [N, F, M] =>
                        carry::fit_scalar(self.fits::<_, N, F>(Points::Standing, space)?, values, &mut fitted)));
                });
            }
            Operation::CarryScalar(field) => {
                with_taken!(self.fields, [values = Buffer::Carried(field)], {
                    let departure = self.fields.real(Buffer::Departure)?;
                    let from = (departure, self.fields.index(Buffer::DepartureNearest)?);
                    let held = field == Carried::Temperature;
                    let reach = if held { Some(self.fields.real(Buffer::Reach(field))?) } else { None };
                    with_space!(self.domain, space => with_order!(order, [N, F, M] => carry::carry_scalar::<T, _, N>(
                        space,
                        self.standing(Buffer::Position)?,
                        self.standing(Buffer::Support)?,
                        from,
                        self.fields.real(Buffer::ScalarFit)?,
                        reach,
                        sizes.points,
                        &mut values,
                    )));
                });
            }
            Operation::Diffuse(field, Stage::Start) => {
                with_taken!(self.fields, [middle = Buffer::ScalarMiddle], {
                    let values = self.fields.real(Buffer::Carried(field))?;
                    let quarter = T::from_f64(0.25 * clock.dt);
                    diffuse::diffuse(self.exchange(field)?, values, Some(values), quarter, &mut middle);
                });
            }
            Operation::Diffuse(field, Stage::Middle) => {
                with_taken!(self.fields, [values = Buffer::Carried(field)], {
                    let middle = self.fields.real(Buffer::ScalarMiddle)?;
                    let half = T::from_f64(0.5 * clock.dt);
                    diffuse::diffuse(self.exchange(field)?, middle, None, half, &mut values);
                });
            }
            Operation::HeatWalls(stage) => {
                let (buffer, share) = match stage {
                    Stage::Start => (Buffer::ScalarMiddle, 0.25),
                    Stage::Middle => (Buffer::Carried(Carried::Temperature), 0.5),
                };
                with_taken!(self.fields, [out = buffer], {
                    let supply = self.fields.real(Buffer::HeatSupply)?;
                    diffuse::heat_walls(supply, T::from_f64(share * clock.dt), &mut out);
                });
            }
            _ => {
                let constants = &scene.constants;
                let change = (clock.kick * constants.lift).to_array().map(T::from_f64);
                let reference = T::from_f64(constants.reference_temperature);
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let temperature = self.fields.real(Buffer::Carried(Carried::Temperature))?;
                    buoyancy::buoyancy(temperature, reference, change, &mut kick);
                });
            }
        }
        Ok(())
    }

    fn exchange(&self, field: Carried) -> Result<Exchange<'_, T>, EngineError> {
        Ok(Exchange { faces: self.faces()?, reach: self.fields.real(Buffer::Reach(field))? })
    }
}
