//! What follows from a case as a whole.

use super::{Case, Effects, SideName, Solution};

impl SideName {
    pub fn word(self) -> &'static str {
        match self {
            SideName::Left => "left",
            SideName::Right => "right",
            SideName::Bottom => "bottom",
            SideName::Top => "top",
        }
    }
}

impl Case {
    /// True where some effect changes the velocity: not where it is prescribed, nor where fluid at rest only conducts.
    pub fn velocity_changes(&self) -> bool {
        let Effects { viscosity, pressure, advection, gravity, heat: _, buoyancy, tracers: _ } = &self.effects;
        let pushed = viscosity.is_some() || pressure.is_some() || gravity.is_some() || buoyancy.is_some();
        pushed || (advection.is_some() && !self.is_solved_by(Solution::Rotation))
    }

    /// True of the case that asks for this exact solution.
    pub fn is_solved_by(&self, solution: Solution) -> bool {
        self.exact.as_ref().is_some_and(|exact| exact.solution == solution)
    }

    /// True where fluid comes and goes through the sides and a pressure has to know.
    pub fn flows_through(&self) -> bool {
        self.is_solved_by(Solution::Kovasznay)
    }

    /// True where heat flows through a side at a prescribed rate.
    pub fn has_heat_flux(&self) -> bool {
        self.boundaries.each().iter().any(|(_, wall)| wall.heat_flux.is_some_and(|flux| flux != 0.0))
    }
}
