// One cycle through the grids of the coarse pressure, in four parts: `restrict` sums a residual up over the cells, `down` over four
// cells at a time, `coarser` goes through the coarser grids and back, `up` ends on the finest. One damped Jacobi step stands before and
// one after on each grid. See `src/cpu/operations/coarse.rs`.

#import coarse_grids

fn smoothing(place: u32) -> real {
    return coarse_matrix[9u * PLACES + place];
}

fn entry(number: u32, place: u32) -> real {
    return coarse_matrix[number * PLACES + place];
}

// The right side, and the first smoothing.
fn begin(place: u32, right: real) {
    coarse_right[place] = right;
    coarse_value[place] = smoothing(place) * right;
}

// b - K x at a cell of a grid with rows so far apart. A cell without unknowns has no row, and nothing on its right side.
fn left_at(place: u32, stride: u32) -> real {
    if smoothing(place) == real(0.0) {
        return real(0.0);
    }
    let below = place - stride;
    let above = place + stride;
    var left = coarse_right[place];
    left -= entry(0u, place) * coarse_value[below - 1u];
    left -= entry(1u, place) * coarse_value[below];
    left -= entry(2u, place) * coarse_value[below + 1u];
    left -= entry(3u, place) * coarse_value[place - 1u];
    left -= entry(4u, place) * coarse_value[place];
    left -= entry(5u, place) * coarse_value[place + 1u];
    left -= entry(6u, place) * coarse_value[above - 1u];
    left -= entry(7u, place) * coarse_value[above];
    left -= entry(8u, place) * coarse_value[above + 1u];
    return left;
}

fn left_on(grid: Level, place: u32) -> real {
    return left_at(place, grid.columns + 2u);
}

fn parent_of(fine: Level, coarse: Level, cell: u32) -> u32 {
    return parent_in(coarse, cell % fine.columns + 1u, cell / fine.columns + 1u);
}

// What the four cells of a coarse one leave.
fn left_below(fine: Level, coarse: Level, cell: u32) -> real {
    let stride = fine.columns + 2u;
    var sum = real(0.0);
    for (var child = 0u; child < 4u; child++) {
        sum += left_at(child_of(fine, coarse, cell, child), stride);
    }
    return sum;
}
