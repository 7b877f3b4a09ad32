//! What the sides let through, and the velocity of those that follow the fluid.

use glam::DVec2;

use super::Scene;
use crate::cloud::OpenPoint;
use crate::cloud::voronoi::{Boundary, Cells};
use crate::cpu::blocks;
use crate::engine::Data;
use crate::step::Buffer;

/// The volume flux out of every cell through its pieces of the sides, m^2/s: the velocity at the middle of each piece, times the
/// piece. What comes in leaves through an outlet, whose cells have no equation: nothing has to be evened out.
pub(super) fn wall_flux(scene: &Scene, cells: &Cells) -> Vec<f64> {
    let mut flux = vec![0.0; scene.cloud.len()];
    for piece in &cells.walls {
        let velocity = match piece.of {
            Boundary::Side(side) => side.velocity(&scene.case.boundaries, piece.middle, scene.cloud.size),
            Boundary::Obstacle(_) => None,
        };
        if !scene.is_outlet(piece.point) {
            flux[piece.point] += velocity.unwrap_or(DVec2::ZERO).dot(piece.area);
        }
    }
    flux
}

/// Which points are those of outlets.
pub(super) fn outlets(scene: &Scene) -> (Buffer, Data) {
    let is_outlet = |point: usize| u32::from(point < scene.cloud.len() && scene.is_outlet(point));
    (Buffer::Outlet, Data::Index((0..scene.padded()).map(is_outlet).collect()))
}

/// The rows of the points of slip sides and outlets.
pub(super) fn rows(scene: &Scene, open: &[OpenPoint]) -> Vec<(Buffer, Data)> {
    let slots = scene.sizes.open_capacity;
    let length = scene.padded() * slots;
    let (mut points, mut row, mut count) = (vec![0; length], vec![0.0; length], vec![0; scene.padded()]);
    let mut normal = vec![DVec2::ZERO; scene.cloud.len()];
    for OpenPoint { point, row: shares, normal: own } in open {
        for slot in 0..slots {
            let at = blocks::at(*point, slot, slots);
            (points[at], row[at]) =
                shares.get(slot).map_or((*point as u32, 0.0), |&(other, share)| (other as u32, share));
        }
        count[*point] = shares.len() as u32;
        normal[*point] = *own;
    }
    vec![
        (Buffer::OpenPoints, Data::Index(points)),
        (Buffer::OpenRow, Data::Real(row)),
        (Buffer::OpenCount, Data::Index(count)),
        (Buffer::OpenNormal, scene.vectors(&normal, DVec2::ZERO)),
    ]
}
