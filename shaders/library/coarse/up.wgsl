// The coarse pressure arrives on the finest grid and is smoothed there; its product with the residual over the cells.

#import sums
#import coarse_cycle

// What stands at a cell, `x` and `y` one more than its column and row, once the coarser grid's is added.
fn value_at(place: u32, x: u32, y: u32) -> real {
    if cells_of(SECOND) > 0u {
        return coarse_value[place] + coarse_smoothed[parent_in(SECOND, x, y)];
    }
    return coarse_value[place];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    var product = real(0.0);
    if cell < CELLS {
        let place = place_of(FINEST, cell);
        let factor = smoothing(place);
        if factor != real(0.0) {
            let x = cell % CELLS_X + 1u;
            let y = cell / CELLS_X + 1u;
            let below = place - CELLS_X - 2u;
            let above = place + CELLS_X + 2u;
            let own = value_at(place, x, y);
            var left = coarse_right[place];
            left -= entry(0u, place) * value_at(below - 1u, x - 1u, y - 1u);
            left -= entry(1u, place) * value_at(below, x, y - 1u);
            left -= entry(2u, place) * value_at(below + 1u, x + 1u, y - 1u);
            left -= entry(3u, place) * value_at(place - 1u, x - 1u, y);
            left -= entry(4u, place) * own;
            left -= entry(5u, place) * value_at(place + 1u, x + 1u, y);
            left -= entry(6u, place) * value_at(above - 1u, x - 1u, y + 1u);
            left -= entry(7u, place) * value_at(above, x, y + 1u);
            left -= entry(8u, place) * value_at(above + 1u, x + 1u, y + 1u);
            let smoothed = own + factor * left;
            coarse_smoothed[place] = smoothed;
            product = coarse_right[place] * smoothed;
        }
    }
    let number = group_of(group);
    add_up_one_to(GROUPS + number, number < COARSE_GROUPS, local, product);
}
