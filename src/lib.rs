//! Stillpoint: meshfree simulation of 2D incompressible flow on points that stand still.

pub mod case;
pub mod cli;
pub mod cloud;
pub mod compare;
pub mod comparison;
pub mod cpu;
pub mod direct;
pub mod engine;
pub mod exact;
pub mod gpu;
pub mod known;
pub mod measure;
pub mod motion;
pub mod output;
pub mod run;
pub mod scene;
pub mod simulation;
pub mod snapshot;
pub mod step;
pub mod study;
