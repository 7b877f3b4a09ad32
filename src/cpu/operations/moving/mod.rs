//! Points that move and stay where they have moved to: the free surface, walls as mirrors, the pressure, the shift.
//!
//! The fits are those of order 2: five coefficients, their factor, their moments.

pub mod collide;
pub mod density;
pub mod fits;
pub mod least;
pub mod mirror;
pub mod pressure;
pub mod shift;
pub mod surface;
pub mod travel;

use crate::cpu::operations::moments;

/// Degree of the fits.
pub const ORDER: usize = 2;
/// Coefficients of a fit, entries of its factor, sums of its normal matrix.
pub const N: usize = moments::coefficients(ORDER);
pub const F: usize = moments::entries(N);
pub const M: usize = moments::moments(ORDER);
