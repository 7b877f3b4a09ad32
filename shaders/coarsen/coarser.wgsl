// The pressure matrix over cells, 3 of 3: the coarser grids, K_(l+1) = R K_l R^T / COARSE_SCALE, R the sum over four cells; by one workgroup.

#import coarse_grids
#import coarse_store
#import written/coarse_matrix

// Where a cell so many columns or rows further on lies, seen from the coarse cell.
fn across(fine: u32, way: u32) -> u32 {
    return (fine + 1u + way) / 2u - fine / 2u;
}

fn sum_up(fine: Level, coarse: Level, local: u32) {
    for (var cell = local; cell < cells_of(coarse); cell += REDUCERS) {
        clear();
        for (var child = 0u; child < 4u; child++) {
            let place = child_of(fine, coarse, cell, child);
            // A cell without unknowns has no row.
            if coarse_matrix[4u * PLACES + place] != real(0.0) {
                for (var number = 0u; number < 9u; number++) {
                    let to = 3u * across(child / 2u, number / 3u) + across(child % 2u, number % 3u);
                    add(to, coarse_matrix[number * PLACES + place]);
                }
            }
        }
        store(place_of(coarse, cell), real(1.0) / COARSE_SCALE);
    }
}

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    sum_up_all(local);
}
