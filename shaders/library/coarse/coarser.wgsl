// Down through the levels above the finest and up again, by one workgroup.

#import coarse_cycle
#import written/coarse_cycle

fn go_down(fine: Level, coarse: Level, local: u32) {
    for (var cell = local; cell < cells_of(coarse); cell += REDUCERS) {
        begin(place_of(coarse, cell), left_below(fine, coarse, cell));
    }
}

fn bring_up(fine: Level, coarse: Level, local: u32) {
    for (var cell = local; cell < cells_of(fine); cell += REDUCERS) {
        let place = place_of(fine, cell);
        if smoothing(place) != real(0.0) {
            coarse_value[place] += coarse_smoothed[parent_of(fine, coarse, cell)];
        }
    }
}

fn smooth_out(grid: Level, local: u32) {
    for (var cell = local; cell < cells_of(grid); cell += REDUCERS) {
        let place = place_of(grid, cell);
        let factor = smoothing(place);
        if factor != real(0.0) {
            coarse_smoothed[place] = coarse_value[place] + factor * left_on(grid, place);
        }
    }
}

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    go_through_all(local);
}
