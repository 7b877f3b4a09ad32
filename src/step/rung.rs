//! The ladder that a point's fit steps down when its normal matrix is too weak.

use crate::case::WIDEST_LADDER;

/// Where on the ladder a point's fit stands, as stored: 0 for the full fit at the radius asked for, then the steps of
/// [`Rung::WIDER`], then fits of lower order at that radius, [`Rung::LINEAR`] the last, then [`Rung::NEAREST`].
pub struct Rung;

impl Rung {
    /// Wider radii tried, over `r_e`; the last is the cap.
    pub const WIDER: [f64; 3] = [1.25, 1.5, WIDEST_LADDER];
    /// Two coefficients, the gradient; second derivatives are zero.
    pub const LINEAR: u32 = Self::lowered(1);
    /// No coefficient: the value of the nearest point.
    pub const NEAREST: u32 = Self::LINEAR + 1;
    /// The pivot test failed and the ladder has not been tried yet.
    pub const FAILED: u32 = u32::MAX;

    /// A fit of a lower order, 3, 2 or 1.
    pub const fn lowered(order: u32) -> u32 {
        Self::WIDER.len() as u32 + 4 - order
    }
}
