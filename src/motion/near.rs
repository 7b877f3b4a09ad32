//! How near points stand to each other, and which of them hang together.

use std::ops::Range;

use glam::DVec2;

use crate::cloud::grid::Grid;

/// Points of a body of fluid below which it is a droplet.
const DROPLET: u32 = 12;

/// What one pass over the pairs of points in touching cells finds.
pub(super) struct Near {
    /// Cell by cell, m.
    position: Vec<DVec2>,
    /// Of each its distance to the nearest other, squared, m^2; infinite where the cells around hold none.
    square: Vec<f64>,
    bodies: Bodies,
}

impl Near {
    /// Of points in a rectangle of `size`. Nearer than `joined`, m, two belong to one body of fluid.
    pub fn new(position: &[DVec2], size: DVec2, joined: f64) -> Self {
        let grid = Grid::new(position, size, DVec2::ZERO, joined);
        let position: Vec<DVec2> = grid.sorted().iter().map(|&point| position[point as usize]).collect();
        let (square, bodies) = (vec![f64::INFINITY; position.len()], Bodies::apart(position.len()));
        let mut near = Self { position, square, bodies };
        let (cells, mut joins) = (grid.cells(), Vec::new());
        for row in 0..cells.y {
            for column in 0..cells.x {
                let own = grid.span(row, column..column + 1);
                if own.is_empty() {
                    continue;
                }
                // Each pair once: what follows in this row, and the row above.
                let right = (column + 2).min(cells.x);
                let beside = grid.span(row, column..right);
                let above = match row + 1 < cells.y {
                    true => grid.span(row + 1, column.saturating_sub(1)..right),
                    false => 0..0,
                };
                for point in own {
                    near.meet(point, point + 1..beside.end, joined, &mut joins);
                    near.meet(point, above.clone(), joined, &mut joins);
                }
            }
        }
        near
    }

    /// A point and a range of others. `joins` is memory for those of them that it belongs with.
    fn meet(&mut self, point: usize, others: Range<usize>, joined: f64, joins: &mut Vec<usize>) {
        if joins.len() < others.len() {
            joins.resize(others.len(), 0);
        }
        let (place, mut least, mut count) = (self.position[point], self.square[point], 0);
        let pairs = self.position[others.clone()].iter().zip(&mut self.square[others.clone()]);
        for (other, (there, square)) in others.zip(pairs) {
            let apart = (*there - place).length_squared();
            least = if apart < least { apart } else { least };
            *square = if apart < *square { apart } else { *square };
            joins[count] = other;
            count += usize::from(apart < joined * joined);
        }
        self.square[point] = least;
        joins[..count].iter().for_each(|&other| self.bodies.join(point, other));
    }

    /// Least, mean and largest distance of a point to the one nearest to it, over `spacing`; zeros where every point is alone.
    pub fn nearest(&self, spacing: f64) -> [f64; 3] {
        let distances = self.square.iter().filter(|square| square.is_finite()).map(|square| square.sqrt() / spacing);
        let (mut least, mut sum, mut most, mut count) = (f64::INFINITY, 0.0, 0.0_f64, 0_u32);
        for distance in distances {
            (least, sum, most, count) = (least.min(distance), sum + distance, most.max(distance), count + 1);
        }
        if count == 0 { [0.0; 3] } else { [least, sum / f64::from(count), most] }
    }

    /// The places of every body of fluid that is no droplet, m; of the largest where all are.
    pub fn largest_bodies(&mut self) -> Vec<DVec2> {
        let mut size = vec![0; self.position.len()];
        let body: Vec<usize> = (0..self.position.len()).map(|point| self.bodies.of(point)).collect();
        body.iter().for_each(|&body| size[body] += 1);
        let least = size.iter().copied().max().map_or(0, |most| DROPLET.min(most));
        let kept = self.position.iter().zip(&body).filter(|(_, body)| size[**body] >= least);
        kept.map(|(&place, _)| place).collect()
    }
}

/// Disjoint sets of points, each a tree under its first point.
struct Bodies {
    /// The point above each; of a first point itself.
    above: Vec<u32>,
}

impl Bodies {
    fn apart(points: usize) -> Self {
        Self { above: (0..points as u32).collect() }
    }

    /// The first point of the set of a point.
    fn of(&mut self, mut point: usize) -> usize {
        loop {
            let above = self.above[point] as usize;
            if above == point {
                return point;
            }
            // Half of the way is cut off for the next.
            self.above[point] = self.above[above];
            point = above;
        }
    }

    fn join(&mut self, one: usize, other: usize) {
        if self.above[one] == self.above[other] {
            return;
        }
        let (one, other) = (self.of(one), self.of(other));
        self.above[one.max(other)] = one.min(other) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::tests::random_cloud;

    /// Each pair on its own: those in the cells around a place, and whoever can be reached from a point.
    #[test]
    fn one_pass_over_pairs_finds_what_each_point_on_its_own_does() {
        let size = DVec2::new(1.0, 0.7);
        for (count, spacing) in [(1, 0.1), (12, 0.1), (60, 0.1), (400, 0.05), (700, 0.03), (700, 0.003)] {
            let places: Vec<DVec2> = random_cloud(count, 7).into_iter().map(|place| place * size).collect();
            let joined = 1.5 * spacing;
            let grid = Grid::new(&places, size, DVec2::ZERO, joined);
            let around = |place: DVec2| (0..=1).flat_map(|ring| grid.ring(place, ring)).collect::<Vec<_>>();
            let nearest = |point: usize| {
                let others = around(places[point]).into_iter().filter(|&other| other != point);
                others.map(|other| (places[other] - places[point]).length()).fold(f64::INFINITY, f64::min)
            };
            let nearest: Vec<f64> = (0..count).map(nearest).filter(|d| d.is_finite()).map(|d| d / spacing).collect();
            let mut near = Near::new(&places, size, joined);
            let [least, mean, most] = near.nearest(spacing);
            if nearest.is_empty() {
                assert_eq!([least, mean, most], [0.0; 3]);
            } else {
                let expected = nearest.iter().sum::<f64>() / nearest.len() as f64;
                assert!((mean / expected - 1.0).abs() < 1e-14, "{mean}, {expected}");
                assert_eq!(least, nearest.iter().copied().fold(f64::INFINITY, f64::min));
                assert_eq!(most, nearest.iter().copied().fold(0.0, f64::max));
            }
            let (mut body, mut sizes) = (vec![usize::MAX; count], Vec::new());
            for seed in 0..count {
                let (mut next, number) = (vec![seed], sizes.len());
                sizes.push(0);
                while let Some(point) = next.pop() {
                    if body[point] == usize::MAX {
                        (body[point], sizes[number]) = (number, sizes[number] + 1);
                        let beside =
                            |other: &usize| (places[*other] - places[point]).length_squared() < joined * joined;
                        next.extend(around(places[point]).into_iter().filter(beside));
                    }
                }
            }
            let least = sizes.iter().copied().max().expect("a body").min(DROPLET as usize);
            let kept = (0..count).filter(|&point| sizes[body[point]] >= least).map(|point| places[point]);
            let order = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x);
            let (mut kept, mut found) = (kept.collect::<Vec<_>>(), near.largest_bodies());
            kept.sort_by(order);
            found.sort_by(order);
            assert_eq!(found, kept, "{count} points, {spacing} m");
        }
    }
}
