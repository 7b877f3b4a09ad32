//! Whether all points hang together: each sees another, and so on to the last.

use glam::DVec2;

use super::grid::Grid;
use super::shortest;

/// The first point that no chain of points within `radius` of each other leads to from the first one, and how many groups of
/// points there are; `None` where all are of one group.
pub fn first_apart(position: &[DVec2], grid: &Grid, period: DVec2, radius: f64) -> Option<(usize, usize)> {
    let mut seen = vec![false; position.len()];
    let (mut groups, mut apart) = (0, None);
    let mut reached = Vec::new();
    for first in 0..position.len() {
        if seen[first] {
            continue;
        }
        groups += 1;
        if groups == 2 {
            apart = Some(first);
        }
        seen[first] = true;
        reached.push(first);
        while let Some(point) = reached.pop() {
            let own = position[point];
            for other in grid.within(own, radius) {
                if !seen[other] && shortest(position[other] - own, period).length_squared() < radius * radius {
                    seen[other] = true;
                    reached.push(other);
                }
            }
        }
    }
    apart.map(|point| (point, groups))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(position: &[DVec2], period: DVec2) -> Option<(usize, usize)> {
        let grid = Grid::new(position, DVec2::splat(10.0), period, 1.0);
        first_apart(position, &grid, period, 1.0)
    }

    #[test]
    fn points_out_of_sight_are_found_and_chains_followed() {
        let chain: Vec<DVec2> = (0..=10).map(|k| DVec2::new(0.9 * f64::from(k), 5.0)).collect();
        assert_eq!(apart(&chain, DVec2::ZERO), None);
        let mut broken = chain.clone();
        broken.remove(4);
        assert_eq!(apart(&broken, DVec2::ZERO), Some((4, 2)));
        // Around the seam they hang together again.
        broken.push(DVec2::new(9.9, 5.0));
        assert_eq!(apart(&broken, DVec2::new(10.0, 0.0)), None);
        broken.push(DVec2::new(5.0, 0.0));
        assert_eq!(apart(&broken, DVec2::new(10.0, 0.0)), Some((11, 2)));
    }
}
