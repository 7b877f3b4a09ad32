//! What follows from a case as a whole.

use super::{Case, Effects, Preconditioner, Scheme, SideKind, SideName, Solution};

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
        // Drag asks for viscosity.
        let Effects { viscosity, pressure, advection, gravity, drag: _, heat: _, buoyancy, tracers: _ } = &self.effects;
        let pushed = viscosity.is_some() || pressure.is_some() || gravity.is_some() || buoyancy.is_some();
        pushed || (advection.is_some() && !self.is_solved_by(Solution::Rotation))
    }

    /// True where a coarse pressure helps the solver.
    pub fn coarsens(&self) -> bool {
        self.preconditioner() == Some(Preconditioner::Multigrid)
    }

    /// True where the velocity under viscosity is solved for.
    pub fn implicit_viscosity(&self) -> bool {
        self.effects.viscosity.as_ref().is_some_and(|viscosity| viscosity.scheme == Scheme::Implicit)
    }

    /// True of the case that asks for this exact solution.
    pub fn is_solved_by(&self, solution: Solution) -> bool {
        self.exact.as_ref().is_some_and(|exact| exact.solution == solution)
    }

    /// True where fluid comes and goes through the sides at a prescribed velocity and a pressure has to know.
    pub fn flows_through(&self) -> bool {
        self.is_solved_by(Solution::Kovasznay) || self.has_side(SideKind::Inlet)
    }

    /// True where some side is of this kind.
    pub fn has_side(&self, kind: SideKind) -> bool {
        self.boundaries.each().iter().any(|(_, wall)| wall.kind == kind)
    }

    /// True where the velocity on some side follows that of the fluid inside.
    pub fn has_open_sides(&self) -> bool {
        self.has_side(SideKind::Slip) || self.has_side(SideKind::Outlet)
    }

    /// True where heat flows through a side at a prescribed rate.
    pub fn has_heat_flux(&self) -> bool {
        self.boundaries.each().iter().any(|(_, wall)| wall.heat_flux.is_some_and(|flux| flux != 0.0))
    }
}
