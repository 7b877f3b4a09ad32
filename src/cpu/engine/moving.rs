//! Points that move and stay where they have moved to.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::integral::DIMENSIONS;
use crate::cpu::operations::measure;
use crate::cpu::operations::moving::mirror::{Around, Mirrors};
use crate::cpu::operations::moving::surface::Crowd;
use crate::cpu::operations::moving::travel::Tank;
use crate::cpu::operations::moving::{collide, density, fits, least, pressure, shift, surface, travel};
use crate::cpu::real::Real;
use crate::engine::{Clock, EngineError};
use crate::step::{Buffer, Operation, Points};

impl<T: Real> CpuEngine<T> {
    pub(super) fn move_points(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let real = T::from_f64;
        let (interior, weight) = (sizes.interior, constants.weight);
        let dt = real(clock.dt);
        let place = Buffer::Position(Points::Standing);
        let factors = Buffer::Factor(Points::Standing);
        match operation {
            Operation::AdvancePoints => {
                with_taken!(self.fields, [position = place, projected = Buffer::Projected], {
                    travel::advance(self.tank(), dt, interior, &mut position, &mut projected);
                });
            }
            Operation::FactoriseMirrored => {
                let mut rung = self.fields.take_index(Buffer::Rung(Points::Standing))?;
                with_taken!(self.fields, [factor = factors], {
                    let free = self.fields.index(Buffer::Surface)?;
                    fits::factorise(self.mirrored()?, weight, free, &mut factor, &mut rung);
                });
                self.fields.put_index(Buffer::Rung(Points::Standing), rung);
            }
            Operation::FitPredicted | Operation::FitMirrored => {
                let falling = match operation {
                    Operation::FitPredicted => (clock.kick * constants.gravity).to_array().map(real),
                    _ => [T::zero(); 2],
                };
                with_taken!(self.fields, [coefficients = Buffer::Coefficients], {
                    let (factor, velocity) = (self.fields.real(factors)?, self.fields.real(Buffer::Projected)?);
                    fits::fit_velocity(self.mirrored()?, weight, factor, velocity, falling, &mut coefficients);
                });
            }
            Operation::FittedViscosity => {
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let coefficients = self.fields.real(Buffer::Coefficients)?;
                    let diffusion = real(clock.kick * constants.viscosity);
                    fits::viscosity(coefficients, diffusion, real(constants.radius), interior, &mut kick);
                });
            }
            Operation::FindSurface => {
                let mut free = self.fields.take_index(Buffer::Surface)?;
                with_taken!(self.fields, [crowding = Buffer::Crowding], {
                    surface::find_surface(self.mirrored()?, self.crowd(), sizes.pressured, &mut crowding, &mut free);
                });
                self.fields.put_index(Buffer::Surface, free);
            }
            Operation::AssembleMirrored | Operation::AssembleDensity => self.assemble_moving(operation, clock)?,
            Operation::CorrectMirrored => {
                with_taken!(self.fields, [pressures = Buffer::Pressure], {
                    let free = self.fields.index(Buffer::Surface)?;
                    pressure::clamp(self.lists(Points::Standing)?, free, &mut pressures);
                });
                with_taken!(self.fields, [projected = Buffer::Projected, displacement = Buffer::Displacement], {
                    let (factor, pressures) = (self.fields.real(factors)?, self.fields.real(Buffer::Pressure)?);
                    let steps = [dt, real(clock.kick / constants.density)];
                    let (around, equation) = (self.mirrored()?, self.equation(clock));
                    pressure::correct(
                        around,
                        equation,
                        factor,
                        pressures,
                        steps,
                        interior,
                        &mut projected,
                        &mut displacement,
                    );
                });
            }
            Operation::BoundPush => {
                let mut bounded = self.fields.take_index(Buffer::Bounded)?;
                with_taken!(self.fields, [projected = Buffer::Projected, displacement = Buffer::Displacement], {
                    let longest = real(clock.share * clock.share * pressure::LONGEST_PUSH * constants.spacing);
                    pressure::bound_push(longest, dt, interior, &mut projected, &mut displacement, &mut bounded);
                });
                self.fields.put_index(Buffer::Bounded, bounded);
            }
            Operation::CorrectByLeast | Operation::CorrectByMoments => {
                with_taken!(
                    self.fields,
                    [pressures = Buffer::Pressure, projected = Buffer::Projected, displacement = Buffer::Displacement],
                    {
                        least::clamp(&mut pressures);
                        let correction = least::Correction {
                            dt,
                            per_density: real(clock.kick / constants.density),
                            lattice: real(constants.lattice.density),
                            interior,
                            pressured: sizes.pressured,
                        };
                        let around = self.mirrored()?;
                        let correct = match operation {
                            Operation::CorrectByLeast => least::correct_by_least,
                            _ => least::correct_by_moments,
                        };
                        correct(around, &pressures, correction, &mut projected, &mut displacement);
                    }
                );
            }
            Operation::ShiftPoints => {
                with_taken!(self.fields, [projected = Buffer::Projected, displacement = Buffer::Displacement], {
                    let (free, spacing) = (self.fields.index(Buffer::Surface)?, real(constants.spacing));
                    let coefficients = self.fields.real(Buffer::Coefficients)?;
                    let around = self.mirrored()?;
                    shift::shift(
                        around,
                        spacing,
                        real(clock.share),
                        free,
                        coefficients,
                        interior,
                        &mut projected,
                        &mut displacement,
                    );
                });
            }
            Operation::DisplacePoints => {
                with_taken!(self.fields, [position = place, projected = Buffer::Projected], {
                    let way = self.fields.real(Buffer::Displacement)?;
                    travel::displace(self.tank(), way, interior, &mut position, &mut projected);
                });
            }
            _ => {
                with_taken!(self.fields, [position = place, velocity = Buffer::Projected, kick = Buffer::Kick], {
                    let (lists, distance) = (self.lists(Points::Standing)?, real(scene.bounce_distance()));
                    collide::impulses(&position, &velocity, lists, distance, interior, &mut kick);
                    collide::bounce(&kick, dt, interior, &mut position, &mut velocity);
                });
            }
        }
        Ok(())
    }

    /// Root mean square of `div u` over the points inside the fluid, 1/s: by fits, or by weighted means.
    pub(super) fn divergence_of_moving(&self) -> Result<f64, EngineError> {
        let velocity = self.fields.real(Buffer::Projected)?;
        let free = self.fields.index(Buffer::Surface)?;
        let mut divergence = vec![T::zero(); self.scene.padded()];
        let (around, end) = (self.mirrored()?, self.scene.sizes.interior);
        if self.scene.plan.mirrors() {
            let factor = self.fields.real(Buffer::Factor(Points::Standing))?;
            fits::divergence(around, self.scene.constants.weight, factor, velocity, free, end, &mut divergence);
        } else {
            let scale = T::from_f64(DIMENSIONS / self.scene.constants.lattice.density);
            density::divergence(around, scale, velocity, free, end, &mut divergence);
        }
        Ok(measure::rms(&divergence, end))
    }

    fn assemble_moving(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let free = self.fields.index(Buffer::Surface)?.to_vec();
        with_taken!(
            self.fields,
            [
                row = Buffer::MatrixRow,
                diagonal = Buffer::Diagonal,
                source = Buffer::Source,
                pressures = Buffer::Pressure
            ],
            {
                let around = self.mirrored()?;
                let crowding = self.fields.real(Buffer::Crowding)?;
                let scalars = [&mut diagonal[..], &mut source[..], &mut pressures[..]];
                if operation == Operation::AssembleDensity {
                    let stiffness = T::from_f64(scene.stiffness(clock) / density::per_area(scene.constants.lattice));
                    density::assemble(around, stiffness, scene.sizes.pressured, crowding, &free, &mut row, scalars);
                } else {
                    let factor = self.fields.real(Buffer::Factor(Points::Standing))?;
                    let coefficients = self.fields.real(Buffer::Coefficients)?;
                    let equation = self.equation(clock);
                    pressure::assemble(around, equation, factor, crowding, &free, coefficients, &mut row, scalars);
                }
            }
        );
        Ok(())
    }

    pub(super) fn mirrored(&self) -> Result<Around<'_, T>, EngineError> {
        let constants = &self.scene.constants;
        Ok(Around {
            position: self.standing(Buffer::Position)?,
            lists: self.lists(Points::Standing)?,
            mirrors: Mirrors {
                size: constants.size.to_array().map(T::from_f64),
                radius: T::from_f64(constants.radius),
                present: self.scene.plan.mirrors(),
            },
        })
    }

    fn tank(&self) -> Tank<T> {
        let constants = &self.scene.constants;
        Tank {
            size: constants.size.to_array().map(T::from_f64),
            clearance: T::from_f64(travel::CLEARANCE * constants.spacing),
            mirrors: self.scene.plan.mirrors(),
        }
    }

    fn crowd(&self) -> Crowd<T> {
        let constants = &self.scene.constants;
        let integral = !self.scene.plan.mirrors();
        let density = if integral { constants.lattice.density } else { constants.crowd };
        Crowd {
            integral,
            per_density: T::from_f64(1.0 / density),
            fewest: constants.fewest,
            reach: T::from_f64(surface::REACH * constants.spacing / constants.radius),
        }
    }

    fn equation(&self, clock: &Clock) -> pressure::Equation<T> {
        let constants = &self.scene.constants;
        pressure::Equation {
            weight: constants.weight,
            weight_density: (constants.density * constants.gravity).to_array().map(T::from_f64),
            density_per_dt: T::from_f64(constants.density / clock.kick),
            stiffness: T::from_f64(self.scene.stiffness(clock)),
            per_area: T::from_f64(density::per_area(constants.lattice)),
        }
    }
}
