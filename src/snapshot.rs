//! The fields at one instant, as the host sees them: what is printed, drawn, stored and measured.

use glam::DVec2;

/// All points at one time, in the order of the cloud.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Snapshot {
    /// s
    pub time: f64,
    /// m
    pub position: Vec<DVec2>,
    /// m/s
    pub velocity: Vec<DVec2>,
    /// Pa
    pub pressure: Vec<f64>,
    /// In place of velocity and pressure, where the problem is to find them.
    pub derivatives: Option<Derivatives>,
}

/// A known field as the operators see it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Derivatives {
    /// Its value, or, in the integral form, its mean over neighbours; no unit.
    pub value: Vec<f64>,
    /// 1/m
    pub gradient: Vec<DVec2>,
    /// 1/m^2; empty for fits of order 1.
    pub laplacian: Vec<f64>,
}

/// One field, as it is written: its name, and what its columns are called.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Column<'a> {
    Scalar { name: &'static str, column: &'static str, values: &'a [f64] },
    Vector { name: &'static str, columns: [&'static str; 2], values: &'a [DVec2] },
}

impl Snapshot {
    /// The fields that there are.
    pub fn columns(&self) -> Vec<Column<'_>> {
        let vector = |name, columns, values| Column::Vector { name, columns, values };
        let scalar = |name, column, values| Column::Scalar { name, column, values };
        let Some(Derivatives { value, gradient, laplacian }) = &self.derivatives else {
            return vec![vector("velocity", ["u", "v"], &self.velocity), scalar("pressure", "p", &self.pressure)];
        };
        let mut columns =
            vec![scalar("value", "value", value), vector("gradient", ["gradient_x", "gradient_y"], gradient)];
        if !laplacian.is_empty() {
            columns.push(scalar("laplacian", "laplacian", laplacian));
        }
        columns
    }
}

impl Column<'_> {
    /// Name of the field.
    pub fn name(&self) -> &'static str {
        match self {
            Column::Scalar { name, .. } | Column::Vector { name, .. } => name,
        }
    }

    /// Points that it has values of.
    pub fn len(&self) -> usize {
        match self {
            Column::Scalar { values, .. } => values.len(),
            Column::Vector { values, .. } => values.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What its columns are called.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        let (first, second) = match *self {
            Column::Scalar { column, .. } => (column, None),
            Column::Vector { columns: [x, y], .. } => (x, Some(y)),
        };
        std::iter::once(first).chain(second)
    }

    /// Column names and values of one point.
    pub fn at(&self, point: usize) -> impl Iterator<Item = (&'static str, f64)> + use<> {
        let (first, second) = match self {
            Column::Scalar { values, .. } => (values[point], None),
            Column::Vector { values, .. } => (values[point].x, Some(values[point].y)),
        };
        self.names().zip(std::iter::once(first).chain(second))
    }
}
