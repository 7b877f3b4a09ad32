//! Problems without time: all there is to do, once.

use super::rows::Rows;
use super::{Plan, solve_by};
use crate::case::{Case, Motion, Operators, PressureForm, Splitting};
use crate::step::Operation;

impl Plan {
    /// Derivatives of a known field.
    pub(super) fn of_derivatives(case: &Case) -> Self {
        let interpolation = case.method.operators == Operators::Interpolation;
        let laplacian = case.method.second_derivatives();
        let setup = Rows { operators: case.method.operators, graded: false, laplacian, gradient: true }.setup(false);
        let mut kick = vec![Operation::Gradient];
        if laplacian {
            kick.push(Operation::Laplacian);
        }
        if !interpolation {
            kick.push(Operation::Average);
        }
        Self::once(setup, kick, None)
    }

    /// The pressure equation with a known source.
    pub(super) fn of_poisson(case: &Case) -> Self {
        let pressure = case.effects.pressure.clone().unwrap_or_default();
        let mut setup = Vec::new();
        if pressure.form() == PressureForm::Collocated {
            setup = Rows { operators: Operators::Interpolation, graded: false, laplacian: true, gradient: true }
                .setup(false);
            setup.push(Operation::AssembleCollocated);
        }
        let kick = vec![solve_by(pressure.solver())];
        Self { aggregates: case.coarsens(), ..Self::once(setup, kick, Some(pressure.form())) }
    }

    /// All there is to do is the kick.
    fn once(setup: Vec<Operation>, kick: Vec<Operation>, form: Option<PressureForm>) -> Self {
        Self {
            setup,
            on_step: Vec::new(),
            drift: Vec::new(),
            kick,
            form,
            splitting: Splitting::Projection,
            through_flow: false,
            outlets: false,
            carried: Vec::new(),
            flows: false,
            motion: Motion::Fixed,
            aggregates: false,
        }
    }
}
