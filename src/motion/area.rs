//! The area that a fluid covers: that of the union of discs about its points, by counting squares.

use std::array;

use glam::DVec2;

/// Side of a square, in spacings, and radius of a disc, in sides.
const SQUARE: f64 = 0.25;
const RADIUS: f64 = 0.8 / SQUARE;
/// Rows of squares that a disc can hold middles of, and one.
const ROWS: usize = 8;

/// m^2, of points in a rectangle of `size`. A square is covered where a disc holds its middle.
pub(super) fn covered(position: &[DVec2], size: DVec2, spacing: f64) -> f64 {
    let square = SQUARE * spacing;
    let [columns, rows] = [size.x, size.y].map(|length| (length / square).ceil());
    // A bit a square. A disc reaches into the next word of its row at most.
    let width = columns as usize / 64 + 2;
    let mut covered = vec![0_u64; width * rows as usize];
    for place in position {
        let middle = *place / square;
        let low = (middle.y - RADIUS - 0.5).ceil();
        // Half of what each row's line of middles has in the disc.
        let half: [f64; ROWS] = array::from_fn(|row| {
            let off = low + row as f64 + 0.5 - middle.y;
            (RADIUS * RADIUS - off * off).max(0.0).sqrt()
        });
        let begin = half.map(|half| (middle.x - half - 0.5).ceil().max(0.0) as u32);
        let end = half.map(|half| (middle.x + half + 0.5).floor().min(columns) as u32);
        for row in 0..ROWS {
            let at = low + row as f64;
            if half[row] > 0.0 && at >= 0.0 && at < rows {
                cover(&mut covered[at as usize * width..][..width], begin[row], end[row]);
            }
        }
    }
    square * square * covered.iter().map(|bits| f64::from(bits.count_ones())).sum::<f64>()
}

/// Sets the bits `begin..end`, fewer than 64.
fn cover(row: &mut [u64], begin: u32, end: u32) {
    let bits = (1_u64 << end.saturating_sub(begin)) - 1;
    let (word, shift) = (begin as usize / 64, begin % 64);
    row[word] |= bits << shift;
    // In two steps: a shift by 64 is none.
    row[word + 1] |= (bits >> 1) >> (63 - shift);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::tests::random_cloud;

    #[test]
    fn squares_are_covered_whose_middles_are_within_a_disc() {
        let size = DVec2::new(1.0, 0.7);
        // Wider than a word, and than any; as small as a disc.
        for (count, spacing) in [(1, 1.0), (3, 0.3), (40, 0.05), (500, 0.04), (900, 0.01)] {
            let mut places: Vec<DVec2> = random_cloud(count, 3).into_iter().map(|place| place * size).collect();
            places.extend([DVec2::ZERO, size, DVec2::new(0.0, size.y)]);
            let square = SQUARE * spacing;
            let [columns, rows] = [size.x, size.y].map(|length| (length / square).ceil() as usize);
            let middles = (0..columns * rows).map(|k| DVec2::new((k % columns) as f64, (k / columns) as f64) + 0.5);
            let held =
                |middle: &DVec2| places.iter().any(|place| (square * *middle - *place).length() < RADIUS * square);
            let expected = square * square * middles.filter(held).count() as f64;
            let found = covered(&places, size, spacing);
            assert!((found / expected - 1.0).abs() < 1e-14, "{count} points, {spacing} m: {found}, {expected}");
        }
    }

    /// What a disc covers depends on where it is among the squares, and on the mean is its area.
    #[test]
    fn discs_have_their_area() {
        let places: Vec<DVec2> = random_cloud(1000, 5).into_iter().map(|place| 0.2 + 0.6 * place).collect();
        let mean = places.iter().map(|&place| covered(&[place], DVec2::ONE, 0.1)).sum::<f64>() / places.len() as f64;
        let disc = std::f64::consts::PI * 0.08 * 0.08;
        assert!((mean / disc - 1.0).abs() < 0.01, "{mean}, {disc}");
    }
}
