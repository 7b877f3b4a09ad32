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
    /// The fields that the flow carries, by name: the temperature, K, and tracers.
    pub carried: Vec<(String, Vec<f64>)>,
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
    Scalar { name: &'a str, column: &'a str, values: &'a [f64] },
    Vector { name: &'a str, columns: [&'a str; 2], values: &'a [DVec2] },
}

impl Snapshot {
    /// The values of a carried field; none where there is no such field.
    pub fn carried(&self, name: &str) -> &[f64] {
        self.carried.iter().find(|(own, _)| own == name).map_or(&[], |(_, values)| values)
    }

    /// The fields that there are.
    pub fn columns(&self) -> Vec<Column<'_>> {
        fn vector<'a>(name: &'a str, columns: [&'a str; 2], values: &'a [DVec2]) -> Column<'a> {
            Column::Vector { name, columns, values }
        }
        fn scalar<'a>(name: &'a str, column: &'a str, values: &'a [f64]) -> Column<'a> {
            Column::Scalar { name, column, values }
        }
        let Some(Derivatives { value, gradient, laplacian }) = &self.derivatives else {
            let mut columns =
                vec![vector("velocity", ["u", "v"], &self.velocity), scalar("pressure", "p", &self.pressure)];
            columns.extend(self.carried.iter().map(|(name, values)| scalar(name, name, values)));
            return columns;
        };
        let mut columns =
            vec![scalar("value", "value", value), vector("gradient", ["gradient_x", "gradient_y"], gradient)];
        if !laplacian.is_empty() {
            columns.push(scalar("laplacian", "laplacian", laplacian));
        }
        columns
    }
}

impl<'a> Column<'a> {
    /// Name of the field.
    pub fn name(&self) -> &'a str {
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
    pub fn names(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        let (first, second) = match *self {
            Column::Scalar { column, .. } => (column, None),
            Column::Vector { columns: [x, y], .. } => (x, Some(y)),
        };
        std::iter::once(first).chain(second)
    }

    /// Column names and values of one point.
    pub fn at(&self, point: usize) -> impl Iterator<Item = (&'a str, f64)> + use<'a> {
        let (first, second) = match self {
            Column::Scalar { values, .. } => (values[point], None),
            Column::Vector { values, .. } => (values[point].x, Some(values[point].y)),
        };
        self.names().zip(std::iter::once(first).chain(second))
    }
}
