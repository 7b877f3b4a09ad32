//! Points that stay where they have moved to, or near there: everything that depends on their places is made anew in every step.

use super::{Plan, solve_by};
use crate::case::{self, Case, Motion, Operators, Solver, Splitting};
use crate::step::{Operation, Points, Stage};

/// A solve, with a coarse pressure where one helps it along.
fn coarse_solve(case: &Case, solver: Solver) -> Vec<Operation> {
    let coarse = case.coarsens().then_some(Operation::Coarsen);
    coarse.into_iter().chain([solve_by(solver)]).collect()
}

impl Plan {
    /// A flow whose points move.
    pub(super) fn of_moving(case: &Case) -> Self {
        use Operation::*;
        let effects = &case.effects;
        let (motion, standing) = (case.motion(), Points::Standing);
        let integral = case.method.operators == Operators::Integral;
        let pressure = effects.pressure.clone().unwrap_or_default();
        let (mut setup, mut drift, mut kick) = (Vec::new(), vec![KeepVelocity, ClearKick], Vec::new());
        let search = [BuildCells(standing), FindNeighbours(standing)];
        if effects.viscosity.is_some() {
            setup.extend(search);
            match integral {
                true => setup.push(AssembleIntegralLaplacian),
                false => setup.extend([FindSurface, FactoriseMirrored, FitMirrored]),
            }
            drift.push(if integral { Viscosity(Stage::Start) } else { FittedViscosity });
        }
        if effects.gravity.is_some() {
            drift.push(Gravity);
        }
        drift.push(Predict);
        if integral && effects.gravity.is_some() {
            // Gravity reached the walls' points.
            drift.push(HoldWalls);
        }
        drift.push(AdvancePoints);
        drift.extend(search);
        // The paper's interpolation form has nothing to hold points apart.
        if integral || motion == Motion::Shifted {
            drift.push(Collide);
        }
        kick.push(FindSurface);
        if integral {
            if effects.viscosity.is_some() {
                kick.push(AssembleIntegralLaplacian);
            }
            kick.push(AssembleDensity);
            kick.extend(coarse_solve(case, pressure.solver()));
            kick.push(match pressure.gradient() {
                case::Gradient::Corrected => CorrectByMoments,
                _ => CorrectByLeast,
            });
        } else {
            kick.extend([FactoriseMirrored, FitPredicted, AssembleMirrored]);
            kick.extend(coarse_solve(case, pressure.solver()));
            kick.push(CorrectMirrored);
            if motion == Motion::Shifted {
                kick.push(BoundPush);
            }
            if motion == Motion::Shifted || effects.viscosity.is_some() {
                kick.push(FitMirrored);
            }
            if motion == Motion::Shifted {
                kick.push(ShiftPoints);
            }
        }
        kick.push(DisplacePoints);
        Self {
            setup,
            on_step: Vec::new(),
            drift,
            kick,
            form: Some(pressure.form()),
            splitting: Splitting::Projection,
            through_flow: false,
            outlets: false,
            carried: Vec::new(),
            flows: true,
            motion,
            aggregates: false,
        }
    }
}
