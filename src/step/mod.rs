//! The time step as data: what is stored, which operations run on it, in which order.
//!
//! One step, for a scene with everything (kick, drift, kick, seen from the middle of a kick):
//!
//! ```text
//! drift   fit_velocity        fits of the velocity u' that moves the points
//!         remap_departure     u(r0) = u'(where the fluid came from)            values stand on the points again
//! kick    gravity             kick = (dt/2) g
//!         viscosity           kick += (dt/2) nu lap u
//!         estimate_middle     u_m ~ u + kick - last pressure kick
//!         gravity             kick = (dt/2) g
//!         viscosity           kick += (dt/2) nu lap u_m
//!         predict             u* = u + kick
//!         divergence          b = -(rho / (dt/2)) V div u*
//!         conjugate_gradient  K p = b                                          recomputed residual below the tolerance
//!         correct_by_fit      u_m = u* - (dt/2 rho) grad p                     div u_m = 0: what is reported
//!         hold_walls          u_m = u_wall on walls                                gravity reached them
//!         reflect             u' = u_m + kick - (dt/2 rho) grad p
//! ```
//!
//! Implicit viscosity stands in place of the two explicit ones:
//!
//! ```text
//!         estimate_middle     b = u + kick - G, the kick of the mean pressure P
//!         implicit_viscosity  (V + (dt/2) nu K) u_m = V b
//!         implicit_kick       kick += u_m - b
//!         predict_implicit    u_m + theta G, of which the source b is taken
//!         add_mean_pressure   d = -(h / rho) (b - theta K P) / V,  b += (1 - theta) K P     then solve, predict, correction, reflection
//!         relax_pressure      P += (p - P - rho nu d) / 2
//!         mean_kick_by_fit    G = (dt/2 rho) grad P
//! ```
//!
//! The paper's own step (`splitting = "projection"`) is the same cycle with whole kicks and no reflection.

pub mod aggregates;
mod buffer;
mod carried;
pub mod coarse;
mod effect;
mod grid;
mod operation;
mod plan;
mod rung;

pub use buffer::{Buffer, Element, Points};
pub use carried::Carried;
pub use effect::Effect;
pub use grid::Grid;
pub use operation::{Equation, Kicked, Operation, Stage};
pub use plan::{Plan, Sizes};
pub use rung::Rung;

/// Points a block: multi-component arrays keep the numbers of 32 points together, number by number, so that
/// neighbouring lanes of either engine read neighbouring addresses.
pub const BLOCK: usize = 32;
/// Share of the newest pressure kick in the relaxed mean that the reflection uses.
pub const PRESSURE_RELAXATION: f64 = 0.5;
