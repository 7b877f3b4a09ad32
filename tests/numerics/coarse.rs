//! The coarse pressure of points that move: its matrices are sums of the points', its cycle is linear and symmetric, and solves that it
//! helps take few iterations, hardly more with many points than with few.

use std::path::Path;

use stillpoint::case::Case;
use stillpoint::cpu::blocks;
use stillpoint::cpu::operations::coarse::{Coarse, Correction, Gridded, Grids, SCALE, Vectors};
use stillpoint::step::coarse::{AROUND, Level, levels};
use stillpoint::step::{Buffer, Operation, Points};

use crate::bench::Bench;

const STANDING: Points = Points::Standing;

/// A column of so many points across and twice as many up, up to where its pressure is solved for.
fn column(across: u32, changes: &[&str]) -> Bench {
    let text = "title = 'a column'\n\
                domain = { width = 2.5, height = 2.5 }\n\
                cloud = { arrangement = 'jittered', jitter = 0.1, fill = { from = [0.0, 0.0], to = [1.0, 2.0] } }\n\
                fluid.density = 2.0\n\
                effects.gravity.acceleration = [0.0, -1.0]\n\
                effects.pressure = {}\n\
                effects.advection.motion = 'shifted'\n\
                time = { end = 1.0, courant = 0.2 }\n";
    let mut changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    changes.push(format!("cloud.spacing={:?}", 1.0 / f64::from(across)));
    let mut bench = Bench::new(&Case::from_text(text, Path::new("column.toml"), &changes).expect("a case"));
    bench.clock = bench.scene.clock(0.01 / f64::from(across));
    let plan = bench.scene.plan.clone();
    let step: Vec<_> = plan.drift.iter().chain(&plan.kick).copied().collect();
    let solve = step.iter().position(|&operation| operation == Operation::Coarsen).expect("a coarse pressure");
    bench.apply(&step[..=solve]);
    bench
}

const MPS: [&str; 2] = ["effects.advection.motion='lagrangian'", "method.operators='integral'"];
const FITS: [&str; 0] = [];

/// What a cell's row has for the cell so many columns and rows away.
fn entry(matrix: &[f64], places: usize, place: usize, way: [i64; 2]) -> f64 {
    matrix[(3 * (way[1] + 1) + way[0] + 1) as usize * places + place]
}

#[test]
fn a_row_of_the_finest_grid_is_the_sum_of_its_points_rows() {
    for (changes, sign) in [(&MPS[..], 1.0), (&FITS[..], -1.0)] {
        let mut bench = column(12, changes);
        let (cell, matrix) = (bench.indexes(Buffer::CoarseCell), bench.reals(Buffer::CoarseMatrix));
        let (row, neighbours) = (bench.reals(Buffer::MatrixRow), bench.indexes(Buffer::Neighbours(STANDING)));
        let count = bench.indexes(Buffer::NeighbourCount(STANDING));
        let (places, capacity) = (bench.scene.sizes.coarse, bench.scene.sizes.capacity);
        let finest = levels(&bench.scene.constants.grid)[0];
        // Of a pressure that is 1 in one cell and 0 elsewhere, every cell gets what the points say.
        let mut seen = 0;
        for row_of in 0..finest.rows {
            for column in 0..finest.columns {
                let one = finest.at(column, row_of);
                let p = |point: usize| if cell[point] as usize == one { 1.0 } else { 0.0 };
                let mut sums = vec![0.0; places];
                for i in (0..bench.points()).filter(|&i| cell[i] != 0) {
                    for slot in 0..count[i] as usize {
                        let at = blocks::at(i, slot, capacity);
                        sums[cell[i] as usize] += sign * row[at] * (p(i) - p(neighbours[at] as usize));
                    }
                }
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                    let to = (one as i64 + dx + dy * finest.stride() as i64) as usize;
                    let found = entry(&matrix, places, to, [-dx, -dy]);
                    let scale = matrix[AROUND / 2 * places + one].abs().max(1.0);
                    assert!((found - sums[to]).abs() < 1e-11 * scale, "{changes:?}: {found} is not {}", sums[to]);
                    sums[to] = 0.0;
                    seen += usize::from(found != 0.0);
                }
                assert!(sums.iter().all(|&sum| sum == 0.0), "{changes:?}: a cell beyond the nine around");
            }
        }
        assert!(seen > 100, "{seen}");
    }
}

#[test]
fn a_row_of_a_coarser_grid_is_the_sum_of_those_below_over_the_scale() {
    let mut bench = column(12, &MPS);
    let (matrix, places) = (bench.reals(Buffer::CoarseMatrix), bench.scene.sizes.coarse);
    let levels = levels(&bench.scene.constants.grid);
    let sum_of = |level: Level, x: &dyn Fn(usize, usize) -> f64| -> f64 {
        let mut sum = 0.0;
        for row in 0..level.rows as i64 {
            for column in 0..level.columns as i64 {
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                    let (to_x, to_y) = (column + dx, row + dy);
                    if (0..level.columns as i64).contains(&to_x) && (0..level.rows as i64).contains(&to_y) {
                        let place = level.at(column as usize, row as usize);
                        let product = x(column as usize, row as usize) * x(to_x as usize, to_y as usize);
                        sum += product * entry(&matrix, places, place, [dx, dy]);
                    }
                }
            }
        }
        sum
    };
    // x . K x of any x on the coarse grid is that of the same steps on the fine one.
    let rough = |column: usize, row: usize| ((7 * column + 11 * row) % 5) as f64 - 1.7;
    for pair in levels.windows(2) {
        let fine = sum_of(pair[0], &|column, row| rough(column / 2, row / 2)) / SCALE;
        let coarse = sum_of(pair[1], &rough);
        assert!((fine - coarse).abs() < 1e-12 * fine.abs() && fine > 0.0, "{fine}, {coarse}");
    }
}

#[test]
fn the_cycle_is_linear_and_symmetric_and_positive() {
    let mut bench = column(16, &MPS);
    let (cell, matrix) = (bench.indexes(Buffer::CoarseCell), bench.reals(Buffer::CoarseMatrix));
    let (start, sorted) = (bench.indexes(Buffer::CellStart(STANDING)), bench.indexes(Buffer::CellPoints(STANDING)));
    let levels = levels(&bench.scene.constants.grid);
    let grids = Grids { levels: &levels, start: &start, sorted: &sorted };
    let points = bench.scene.padded();
    let cycle = |r: &[f64]| -> (f64, Vec<f64>) {
        let mut vectors = Vectors::new(bench.scene.sizes.coarse);
        let hierarchy = Gridded::new(grids, &matrix);
        let mut coarse = Coarse { hierarchy, cell: &cell, vectors: &mut vectors };
        let product = coarse.correct(r);
        let out = (0..points).map(|i| vectors.smoothed[cell[i] as usize]).collect();
        (product, out)
    };
    // Nothing is left where the pressure is held.
    let field = |k: usize| -> Vec<f64> {
        (0..points).map(|i| if cell[i] == 0 { 0.0 } else { ((k * i) % 17) as f64 - 7.5 }).collect()
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let (x, y) = (field(3), field(5));
    let ((own, of_x), (_, of_y)) = (cycle(&x), cycle(&y));
    assert!((own - dot(&x, &of_x)).abs() < 1e-12 * own && own > 0.0);
    assert!((dot(&y, &of_x) - dot(&x, &of_y)).abs() < 1e-12 * own);
    let both: Vec<f64> = x.iter().zip(&y).map(|(x, y)| 2.0 * x - y).collect();
    for (i, value) in cycle(&both).1.into_iter().enumerate() {
        let sum = 2.0 * of_x[i] - of_y[i];
        assert!((value - sum).abs() < 1e-11, "point {i}: {value} is not {sum}");
    }
}

#[test]
fn a_solve_with_a_coarse_pressure_takes_few_iterations_however_many_points() {
    for changes in [&MPS[..], &FITS[..]] {
        let iterations = |across: u32, erase: bool| {
            let mut bench = column(across, &[changes, &["effects.pressure.tolerance=1e-8"]].concat());
            if erase {
                // Without rows no coarse pressure comes about.
                bench.engine.write(Buffer::CoarseMatrix, &bench.scene.zeros(Buffer::CoarseMatrix)).expect("zeros");
            }
            let plan = bench.scene.plan.clone();
            let solve = plan.kick.iter().position(|&operation| operation == Operation::Coarsen).expect("a solve") + 1;
            bench.apply(&[plan.kick[solve]]);
            bench.engine.solve_info().iterations
        };
        let [few, many] = [12, 48].map(|across| iterations(across, false));
        let jacobi = iterations(48, true);
        assert!(many < 40 && f64::from(many) < 1.7 * f64::from(few), "{changes:?}: {few} at 12, {many} at 48");
        assert!(jacobi > 4 * many, "{changes:?}: {many} with, {jacobi} without");
    }
}
