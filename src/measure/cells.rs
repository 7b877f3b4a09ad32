//! A cell list: points sorted into square cells, so that the points near a place are found at once.

use glam::DVec2;

use super::MeasureError;

/// Points by cell: a counting sort, so points of a cell keep the order of the cloud.
#[derive(Debug, Clone)]
pub struct CellList {
    origin: DVec2,
    size: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's points start in `order`; one entry more than there are cells.
    start: Vec<usize>,
    order: Vec<usize>,
}

impl CellList {
    /// Sorts points into cells of `size` metres; cells grow where a sparse cloud would need far more cells than points.
    ///
    /// # Errors
    /// No point, a position that is not finite, or a size that is not above zero.
    pub fn new(position: &[DVec2], size: f64) -> Result<Self, MeasureError> {
        if !(size.is_finite() && size > 0.0) {
            return Err(MeasureError::Spacing(size));
        }
        if let Some(point) = position.iter().position(|x| !x.is_finite()) {
            return Err(MeasureError::Position(point));
        }
        let first = *position.first().ok_or(MeasureError::Empty)?;
        let (low, high) = position.iter().fold((first, first), |(low, high), &x| (low.min(x), high.max(x)));
        let extent = high - low;
        let affordable = 4.0 * position.len() as f64 + 64.0;
        let mut size = size;
        while (extent.x / size + 1.0) * (extent.y / size + 1.0) > affordable {
            size *= 1.5;
        }
        let columns = (extent.x / size) as usize + 1;
        let rows = (extent.y / size) as usize + 1;
        let mut list = Self { origin: low, size, columns, rows, start: Vec::new(), order: vec![0; position.len()] };

        let cell: Vec<usize> = position.iter().map(|&x| list.cell_of(x)).collect();
        let mut start = vec![0; columns * rows + 1];
        for &c in &cell {
            start[c + 1] += 1;
        }
        for c in 0..columns * rows {
            start[c + 1] += start[c];
        }
        let mut next = start.clone();
        for (point, &c) in cell.iter().enumerate() {
            list.order[next[c]] = point;
            next[c] += 1;
        }
        list.start = start;
        Ok(list)
    }

    /// Column and row of the cell nearest to a place.
    fn column_row(&self, at: DVec2) -> (usize, usize) {
        let scaled = (at - self.origin) / self.size;
        ((scaled.x.max(0.0) as usize).min(self.columns - 1), (scaled.y.max(0.0) as usize).min(self.rows - 1))
    }

    fn cell_of(&self, at: DVec2) -> usize {
        let (column, row) = self.column_row(at);
        row * self.columns + column
    }

    /// Calls `visit` with every point of the cells that a circle of `radius` metres around `at` touches: all points in
    /// the circle, and some outside it.
    pub fn visit(&self, at: DVec2, radius: f64, mut visit: impl FnMut(usize)) {
        let (left, bottom) = self.column_row(at - DVec2::splat(radius));
        let (right, top) = self.column_row(at + DVec2::splat(radius));
        for row in bottom..=top {
            let (first, last) = (row * self.columns + left, row * self.columns + right);
            for &point in &self.order[self.start[first]..self.start[last + 1]] {
                visit(point);
            }
        }
    }

    /// The point nearest to a place; of two equally near, the first of the cloud.
    pub fn nearest(&self, position: &[DVec2], at: DVec2) -> usize {
        let mut radius = self.size;
        loop {
            let mut best: Option<(f64, usize)> = None;
            self.visit(at, radius, |point| {
                let distance = position[point].distance_squared(at);
                if best.is_none_or(|b| (distance, point) < b) {
                    best = Some((distance, point));
                }
            });
            // A point farther than the circle may be beaten by one in a cell that was not visited.
            match best {
                Some((distance, point)) if distance <= radius * radius => return point,
                Some((distance, _)) => radius = distance.sqrt() * (1.0 + 1e-12),
                None => radius *= 2.0,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::sampler::tests::random_cloud;

    #[test]
    fn finds_what_brute_force_finds() {
        let cloud = random_cloud(400, 3);
        let cells = CellList::new(&cloud, 0.07).unwrap();
        for (k, &at) in random_cloud(200, 5).iter().enumerate() {
            let at = at * 1.4 - DVec2::splat(0.2);
            let radius = 0.05 + 0.001 * k as f64;
            let mut found = Vec::new();
            cells.visit(at, radius, |point| {
                if cloud[point].distance(at) < radius {
                    found.push(point);
                }
            });
            found.sort_unstable();
            let brute: Vec<usize> = (0..cloud.len()).filter(|&i| cloud[i].distance(at) < radius).collect();
            assert_eq!(found, brute);
            let nearest = (0..cloud.len()).min_by(|&a, &b| cloud[a].distance(at).total_cmp(&cloud[b].distance(at)));
            assert_eq!(Some(cells.nearest(&cloud, at)), nearest);
        }
    }

    #[test]
    fn nearest_is_found_from_far_away_and_with_one_point() {
        let cells = CellList::new(&[DVec2::new(1.0, 2.0)], 1e-6).unwrap();
        assert_eq!(cells.nearest(&[DVec2::new(1.0, 2.0)], DVec2::new(-50.0, 80.0)), 0);
    }

    #[test]
    fn a_sparse_cloud_does_not_ask_for_a_huge_grid() {
        let cloud = [DVec2::ZERO, DVec2::splat(1e6)];
        let cells = CellList::new(&cloud, 1e-3).unwrap();
        assert!(cells.start.len() < 200);
        assert_eq!(cells.nearest(&cloud, DVec2::splat(9e5)), 1);
    }

    #[test]
    fn refuses_what_it_cannot_sort() {
        assert_eq!(CellList::new(&[], 1.0).unwrap_err(), MeasureError::Empty);
        assert_eq!(CellList::new(&[DVec2::ZERO], 0.0).unwrap_err(), MeasureError::Spacing(0.0));
        assert_eq!(
            CellList::new(&[DVec2::ZERO, DVec2::new(f64::NAN, 0.0)], 1.0).unwrap_err(),
            MeasureError::Position(1)
        );
    }
}
