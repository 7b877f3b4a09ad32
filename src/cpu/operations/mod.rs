//! The operations, one name each, on slices of `f32` or `f64`.

pub mod bicgstab;
pub mod buoyancy;
pub mod carry;
pub mod coarse;
pub mod collocated;
pub mod conjugate_gradient;
pub mod conservative;
pub mod derivative;
pub mod diffuse;
pub mod drag;
pub mod fit;
pub mod fits;
pub mod gravity;
pub mod implicit_viscosity;
pub mod integral;
pub mod kick;
pub mod lists;
pub mod measure;
pub mod moments;
pub mod moving;
pub mod neighbours;
pub mod open_sides;
pub mod pressure;
pub mod remap;
pub mod rows;
pub mod space;
