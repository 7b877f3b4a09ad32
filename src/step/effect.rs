//! Which effect of a case an operation is there for.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::{Carried, Operation};

/// What is paid for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Effect {
    Advection,
    Heat,
    Tracers,
    Gravity,
    Buoyancy,
    Viscosity,
    Drag,
    Pressure,
    /// Slip sides and outlets.
    Sides,
    /// What every step of a velocity has, and what is done once.
    Step,
}

impl Display for Effect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Effect::Advection => "advection",
            Effect::Heat => "heat",
            Effect::Tracers => "tracers",
            Effect::Gravity => "gravity",
            Effect::Buoyancy => "buoyancy",
            Effect::Viscosity => "viscosity",
            Effect::Drag => "drag",
            Effect::Pressure => "pressure",
            Effect::Sides => "sides",
            Effect::Step => "step",
        })
    }
}

impl Operation {
    /// The effect that the operation belongs to.
    pub fn effect(self) -> Effect {
        use Operation::*;
        match self {
            BuildCells(_) | FindNeighbours(_) | Factorise(_) | WidenSupport(_) => match self.is_of_moved_points() {
                true => Effect::Advection,
                false => Effect::Step,
            },
            AssembleLaplacian
            | AssembleGradient
            | AssembleIntegralLaplacian
            | AssembleIntegralGradient
            | FindLocalNeighbours => Effect::Step,
            FitVelocity(_) | RemapDeparture | MovePoints | RemapForward | FindDepartures | CarryVelocity => {
                Effect::Advection
            }
            FitScalar(Carried::Temperature)
            | CarryScalar(Carried::Temperature)
            | Diffuse(Carried::Temperature, _)
            | HeatWalls(_) => Effect::Heat,
            FitScalar(_) | CarryScalar(_) | Diffuse(..) => Effect::Tracers,
            Gravity | HoldWalls => Effect::Gravity,
            Buoyancy => Effect::Buoyancy,
            Viscosity(_) | EstimateMiddle | ImplicitViscosity | ImplicitKick => Effect::Viscosity,
            Drag => Effect::Drag,
            PredictImplicit | AddMeanPressure | RelaxPressure | MeanKickByFit | MeanKickByAdjoint => Effect::Viscosity,
            AssembleCollocated | Divergence | DivergenceByFit | AddWallFlux | CollocatedSource | Coarsen
            | ConjugateGradient | Bicgstab | DirectSolve | CorrectByFit | CorrectByAdjoint | Reflect => {
                Effect::Pressure
            }
            FindSurface | FitPredicted | AssembleMirrored | AssembleDensity | CorrectMirrored | BoundPush
            | CorrectByLeast | CorrectByMoments => Effect::Pressure,
            AdvancePoints | FactoriseMirrored | FitMirrored | ShiftPoints | DisplacePoints | Collide => {
                Effect::Advection
            }
            FittedViscosity => Effect::Viscosity,
            OpenSides(_) | HoldOutlets => Effect::Sides,
            KeepVelocity | ClearKick | Predict | Average | Gradient | Laplacian => Effect::Step,
        }
    }

    /// True of an operation on the points that the flow has moved.
    pub fn is_of_moved_points(self) -> bool {
        use super::Points::Moved;
        use Operation::*;
        matches!(
            self,
            BuildCells(Moved) | FindNeighbours(Moved) | Factorise(Moved) | WidenSupport(Moved) | FitVelocity(Moved)
        )
    }
}
