//! What is watched while a run goes, and the way back where it goes wrong.

use std::fmt::{self, Display, Formatter};

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::{Diagnostics, Progress, Run, State};
use crate::engine::{Data, EngineError, NonFinite};
use crate::step::Buffer;

/// What keeps a step from being longer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// `time.courant`: how far points may move.
    Courant,
    /// The same, of a point that falls from rest.
    Gravity,
    /// The viscous term is stable up to there.
    Viscosity,
    /// The diffusion of what the flow carries is.
    Diffusion,
    /// `time.step` fixes it.
    Fixed,
    /// Nothing but the time that is left.
    #[default]
    End,
    /// A run that went wrong goes on with shorter steps.
    Guard,
}

impl Limit {
    pub fn name(self) -> &'static str {
        match self {
            Limit::Courant => "courant",
            Limit::Gravity => "gravity",
            Limit::Viscosity => "viscosity",
            Limit::Diffusion => "diffusion",
            Limit::Fixed => "fixed",
            Limit::End => "end",
            Limit::Guard => "guard",
        }
    }
}

impl Display for Limit {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

/// What went wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Trouble {
    /// A field turned non-finite.
    NonFinite { field: NonFinite, place: DVec2 },
    /// More kinetic energy than walls and first velocity can account for, m^4/s^2; where the fluid is fastest.
    Energy { found: f64, most: f64, place: DVec2 },
    /// A figure of a row of diagnostics that is no finite number.
    Figure { name: &'static str, place: DVec2 },
    /// Points that move: the motion is no longer one of the fluid.
    Diverged(String),
    /// Points that are shifted: more energy than there was at the start, so many times as much.
    Grown { times: f64 },
    /// The engine could not go on.
    Engine(EngineError),
    /// No step could be chosen.
    Refused(String),
}

impl Trouble {
    /// Whether shorter steps may do what these could not.
    pub(super) fn may_be_mended(&self) -> bool {
        match self {
            Trouble::NonFinite { .. } | Trouble::Energy { .. } | Trouble::Figure { .. } => true,
            Trouble::Grown { .. } => true,
            Trouble::Engine(error) => {
                matches!(
                    error,
                    EngineError::Direct(_) | EngineError::Viscosity { .. } | EngineError::NeighbourOverflow { .. }
                )
            }
            Trouble::Refused(_) | Trouble::Diverged(_) => false,
        }
    }
}

impl Display for Trouble {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::NonFinite { field, place } => {
                let (name, point) = (field.buffer.name(), field.point);
                write!(out, "{name} of point {point} at ({}, {}) m turned non-finite", place.x, place.y)
            }
            Trouble::Energy { found, most, place } => write!(
                out,
                "the kinetic energy rose to {found:.2e} m^4/s^2, above {most:.2e}, fastest at ({}, {}) m",
                place.x, place.y
            ),
            Trouble::Figure { name, place } => {
                write!(out, "the {name} was no finite number, the fluid fastest at ({}, {}) m", place.x, place.y)
            }
            Trouble::Engine(error) => write!(out, "{error}"),
            Trouble::Grown { times } => write!(out, "the energy has grown to {times:.2} times that at the start"),
            Trouble::Diverged(reason) | Trouble::Refused(reason) => write!(out, "{reason}"),
        }
    }
}

impl Run<'_> {
    /// Looks at a row before it is reported: nothing that is not a finite number is written.
    pub(super) fn watch(&mut self, row: &Diagnostics) -> Result<Option<Trouble>, EngineError> {
        let figures = [
            ("max_speed", row.max_speed),
            ("kinetic_energy", row.kinetic_energy),
            ("divergence", row.divergence),
            ("residual", row.residual),
            ("change", row.change),
        ];
        let lost = figures.into_iter().find(|(_, value)| !value.is_finite());
        let most = self.most_energy;
        if lost.is_none() && row.kinetic_energy <= most {
            return Ok(None);
        }
        let place = self.fastest_place()?;
        Ok(Some(match lost {
            Some((name, _)) => Trouble::Figure { name, place },
            None => Trouble::Energy { found: row.kinetic_energy, most, place },
        }))
    }

    /// Looks at the kinetic energy between two rows.
    pub(super) fn watch_energy(&mut self) -> Result<Option<Trouble>, EngineError> {
        let Data::Real(velocity) = self.engine.read(Buffer::Projected)? else { return Ok(None) };
        let nominal = self.scene.cloud.size.x * self.scene.cloud.size.y / self.scene.sizes.points as f64;
        let volume = |point: usize| self.scene.cells().map_or(nominal, |cells| cells.volume[point]);
        let energy =
            |point: usize| 0.5 * volume(point) * (velocity[2 * point].powi(2) + velocity[2 * point + 1].powi(2));
        let found = (0..self.scene.sizes.points).map(energy).sum::<f64>();
        let most = self.most_energy;
        if found <= most {
            return Ok(None);
        }
        let place = self.fastest_place()?;
        Ok(Some(Trouble::Energy { found, most, place }))
    }

    fn fastest_place(&mut self) -> Result<DVec2, EngineError> {
        let Data::Real(velocity) = self.engine.read(Buffer::Projected)? else { return Ok(DVec2::ZERO) };
        let speed = |point: usize| velocity[2 * point].hypot(velocity[2 * point + 1]);
        let fastest = (0..self.scene.sizes.points).max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
        Ok(fastest.map_or(DVec2::ZERO, |point| self.scene.cloud.position[point]))
    }

    /// Puts the last good state back, to go on from there with half the step.
    pub(super) fn go_back(&mut self, good: &mut State, trouble: &Trouble, step: u64) -> Result<Progress, EngineError> {
        good.write(self.engine)?;
        self.begin_steps(&self.scene.clock(good.progress.dt))?;
        good.progress.halvings += 1;
        good.progress.calm_rows = 0;
        self.warnings.push(format!(
            "in or shortly before step {step} {trouble}; went back to step {} and on with half the step",
            good.progress.step
        ));
        good.progress.warnings.clone_from(&self.warnings);
        Ok(good.progress.clone())
    }
}
