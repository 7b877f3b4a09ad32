//! Stillpoint: meshfree simulation of 2D incompressible flow on points that stand still.

pub mod case;
pub mod measure;
pub mod output;
pub mod simulation;
pub mod snapshot;
