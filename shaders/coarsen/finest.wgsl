// The pressure matrix over cells, 2 of 3: K_0 = R K R^T, R the sum over the points of a cell.
// Shape: ten numbers a place, those of the nine cells around, row by row, then what a smoothing step multiplies with.

#import points
#import coarse_grids
#import coarse_store

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell >= CELLS {
        return;
    }
    let place = place_of(FINEST, cell);
    clear();
    for (var k = cell_start[cell]; k < cell_start[cell + 1u]; k++) {
        let i = cell_points[k];
        let first = at(i, 0u, CAPACITY);
        let free = coarse_cell[i] != 0u;
        let last = first + select(0u, min(neighbour_count[i], CAPACITY), free) * BLOCK;
        for (var slot = first; slot < last; slot += BLOCK) {
            let other = coarse_cell[neighbours[slot]];
            if other != place {
                let factor = COARSE_SIGN * matrix_row[slot];
                s4 += factor;
                // Three rows of cells around; those beside each other stand one apart.
                let way = i32(other) - i32(place);
                let up = select(0, 1, way > 1) - select(0, 1, way < -1);
                let number = 3 * (up + 1) + way - up * i32(CELLS_X + 2u) + 1;
                if other != 0u {
                    add(u32(number), -factor);
                }
            }
        }
    }
    store(place, real(1.0));
}
