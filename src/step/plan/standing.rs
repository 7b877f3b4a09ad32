//! A flow on points that stand still: the drift there and back, then the kick.

use super::rows::Rows;
use super::{Plan, solve_by};
use crate::case::{self, Case, Motion, Pressure, PressureForm, Remap, SideKind, Splitting};
use crate::step::{Carried, Kicked, Operation, Points, Stage};

/// What of a case decides which operations a step has.
struct Flow<'a> {
    case: &'a Case,
    /// Viscosity that is solved for, and with it a pressure of which the mean is known before.
    implicit: bool,
    explicit: bool,
    collocated: bool,
    /// The kick goes on from a mean of its beginning and its end.
    reflects: bool,
    /// Some sides take their velocity from the fluid.
    open: bool,
    /// Forces that do not depend on the velocity.
    weight: Vec<Operation>,
}

impl Plan {
    pub(super) fn of_flow(case: &Case) -> Self {
        let (flow, effects) = (Flow::of(case), &case.effects);
        let rows = Rows {
            operators: case.method.operators,
            graded: !case.cloud.refine.is_empty(),
            laplacian: flow.explicit || flow.collocated,
            gradient: effects.pressure.as_ref().is_some_and(|pressure| pressure.gradient() == case::Gradient::Fit),
        };
        // What carries the velocity evaluates fits, and so do reports where no cells measure the divergence.
        let cells = effects.pressure.is_some() && !flow.collocated;
        let mut setup = rows.setup(effects.advection.is_some() || !cells);
        let (mut on_step, mut drift) = (Vec::new(), flow.diffusion());
        flow.carry(&mut setup, &mut on_step, &mut drift);
        let mut kick = flow.diffusion();
        flow.force(&mut kick);
        if let Some(pressure) = &effects.pressure {
            flow.press(pressure, &mut setup, &mut kick);
        }
        kick.extend(flow.hold());
        if flow.reflects {
            kick.push(Operation::Reflect);
            if flow.open {
                kick.push(Operation::OpenSides(Kicked::After));
            }
        }
        if let (Some(pressure), true) = (&effects.pressure, flow.implicit) {
            let adjoint = pressure.gradient() == case::Gradient::Adjoint;
            let mean = if adjoint { Operation::MeanKickByAdjoint } else { Operation::MeanKickByFit };
            kick.extend([Operation::RelaxPressure, mean]);
        }
        Self {
            setup,
            on_step,
            drift,
            kick,
            form: effects.pressure.as_ref().map(|pressure| pressure.form()),
            splitting: flow.splitting(),
            through_flow: case.flows_through(),
            outlets: case.has_side(SideKind::Outlet),
            carried: case.carried(),
            flows: true,
            motion: Motion::Fixed,
            aggregates: case.coarsens(),
        }
    }
}

impl<'a> Flow<'a> {
    fn of(case: &'a Case) -> Self {
        let (effects, implicit) = (&case.effects, case.implicit_viscosity());
        let weight =
            [(effects.gravity.is_some(), Operation::Gravity), (effects.buoyancy.is_some(), Operation::Buoyancy)];
        let mut flow = Self {
            case,
            implicit,
            explicit: effects.viscosity.is_some() && !implicit,
            collocated: effects.pressure.as_ref().is_some_and(|pressure| pressure.form() == PressureForm::Collocated),
            reflects: false,
            open: case.has_open_sides() && case.velocity_changes(),
            weight: weight.into_iter().filter_map(|(present, operation)| present.then_some(operation)).collect(),
        };
        // A kick of a whole step has no second half, but a mean pressure that implicit viscosity begins from.
        flow.reflects = flow.splitting() == Splitting::Reflection || implicit;
        flow
    }

    /// Without a pressure or a velocity that is solved for there is nothing to reflect.
    fn splitting(&self) -> Splitting {
        let halves = self.case.effects.pressure.is_some() || self.implicit;
        if halves { self.case.time.splitting } else { Splitting::Projection }
    }

    /// Half a step before the drift and half a step after: what is reported is of the time of the velocity.
    fn diffusion(&self) -> Vec<Operation> {
        let mut diffusion = Vec::new();
        for field in self.case.diffusing() {
            for stage in [Stage::Start, Stage::Middle] {
                diffusion.push(Operation::Diffuse(field, stage));
                if field == Carried::Temperature && self.case.has_heat_flux() {
                    diffusion.push(Operation::HeatWalls(stage));
                }
            }
        }
        diffusion
    }

    /// The drift: the flow carries the velocity and the scalar fields.
    fn carry(&self, setup: &mut Vec<Operation>, on_step: &mut Vec<Operation>, drift: &mut Vec<Operation>) {
        use Operation::*;
        let (standing, moved) = (Points::Standing, Points::Moved);
        let (carried, changes) = (self.case.carried(), self.case.velocity_changes());
        let Some(advection) = &self.case.effects.advection else {
            if changes {
                drift.push(KeepVelocity);
            }
            return;
        };
        match advection.remap {
            _ if !carried.is_empty() => {
                if changes {
                    drift.extend([FitVelocity(standing), FindDepartures, CarryVelocity]);
                } else {
                    setup.push(FitVelocity(standing));
                    on_step.push(FindDepartures);
                }
                drift.extend(carried.iter().flat_map(|&field| [FitScalar(field), CarryScalar(field)]));
            }
            Remap::Departure => drift.extend([FitVelocity(standing), RemapDeparture]),
            Remap::Forward => {
                drift.push(MovePoints);
                drift.extend([BuildCells(moved), FindNeighbours(moved), Factorise(moved), WidenSupport(moved)]);
                drift.extend([FitVelocity(moved), RemapForward]);
            }
        }
        if self.open {
            drift.push(OpenSides(Kicked::Before));
        }
    }

    /// Forces, and the velocity that they alone would give.
    fn force(&self, kick: &mut Vec<Operation>) {
        use Operation::*;
        let effects = &self.case.effects;
        if self.case.velocity_changes() {
            kick.push(ClearKick);
        }
        kick.extend(&self.weight);
        if self.implicit {
            kick.extend([EstimateMiddle, ImplicitViscosity]);
            kick.extend(&self.weight);
            kick.push(ImplicitKick);
            if effects.pressure.is_some() {
                kick.push(PredictImplicit);
                return;
            }
        } else if self.explicit {
            kick.extend(self.viscous(Stage::Start));
            if self.reflects {
                kick.push(EstimateMiddle);
                kick.extend(self.hold());
                kick.extend(&self.weight);
                kick.extend(self.viscous(Stage::Middle));
            }
        }
        if self.case.velocity_changes() {
            kick.push(Predict);
        }
    }

    fn viscous(&self, stage: Stage) -> Vec<Operation> {
        let mut forces = vec![Operation::Viscosity(stage)];
        forces.extend(self.case.effects.drag.as_ref().map(|_| Operation::Drag));
        forces
    }

    /// The pressure, and what it makes of the velocity.
    fn press(&self, pressure: &Pressure, setup: &mut Vec<Operation>, kick: &mut Vec<Operation>) {
        use Operation::*;
        kick.push(match pressure.form() {
            PressureForm::Conservative if pressure.divergence() == case::Divergence::Fit => DivergenceByFit,
            PressureForm::Conservative => Divergence,
            PressureForm::Collocated | PressureForm::Integral => {
                setup.push(AssembleCollocated);
                if self.case.has_side(SideKind::Outlet) {
                    setup.push(HoldOutlets);
                }
                CollocatedSource
            }
        });
        if self.case.flows_through() && !self.collocated {
            kick.push(AddWallFlux);
        }
        if self.implicit {
            kick.extend([AddMeanPressure, solve_by(pressure.solver()), Predict]);
        } else {
            kick.push(solve_by(pressure.solver()));
        }
        kick.push(if pressure.gradient() == case::Gradient::Adjoint { CorrectByAdjoint } else { CorrectByFit });
    }

    /// Puts the velocity of walls back, which forces have reached, and that of open sides.
    fn hold(&self) -> Vec<Operation> {
        let pushed = self.collocated || self.case.effects.gravity.is_some();
        let all = [(pushed, Operation::HoldWalls), (self.open, Operation::OpenSides(Kicked::Within))];
        all.into_iter().filter_map(|(present, operation)| present.then_some(operation)).collect()
    }
}
