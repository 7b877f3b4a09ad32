//! Why a cloud could not be laid out.

use crate::case::LARGEST_CLOUD;

/// Why a cloud could not be laid out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CloudError {
    #[error(
        "cloud.minimum_distance = {minimum_distance}: only {placed} of {wanted} random points fit; allowed: about 0.7 or less"
    )]
    Jammed { minimum_distance: f64, placed: usize, wanted: usize },
    #[error(
        "points {first} and {second} coincide at ({x}, {y}) m: no derivative exists between them; \
         allowed: any two points at least {least:e} m apart"
    )]
    Coincident { first: usize, second: usize, x: f64, y: f64, least: f64 },
    #[error("point {point} at ({x}, {y}) m is outside the domain, {width} x {height} m")]
    Outside { point: usize, x: f64, y: f64, width: f64, height: f64 },
    #[error("{0}")]
    Malformed(&'static str),
    #[error("cloud.refine: gives more than {LARGEST_CLOUD:e} points; take larger spacings")]
    TooMany,
    #[error(
        "obstacles.{name}: another part of the boundary is too near to it at ({x}, {y}) m; allowed: at least two spacings of room, \
         and bodies and corners as wide as the spacing around them"
    )]
    Narrow { name: String, x: f64, y: f64 },
    #[error("obstacles.{name}: its parts {fault}")]
    Parts { name: String, fault: &'static str },
    #[error(
        "obstacles.{name}: nowhere deeper than {depth} m, and neighbours would see each other through it; allowed: at least one \
         spacing, {least} m"
    )]
    Thin { name: String, depth: f64, least: f64 },
}
