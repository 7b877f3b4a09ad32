//! A published profile along a line.

/// Values at coordinates along a line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// Coordinate along the line, m.
    pub coordinate: Vec<f64>,
    /// m/s or Pa
    pub value: Vec<f64>,
}
