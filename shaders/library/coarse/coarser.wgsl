// Down through the grids above the finest and up again, by one workgroup.

#import coarse_cycle

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    for (var level = 2u; level < LEVELS; level++) {
        for (var cell = local; cell < cells_of(level); cell += REDUCERS) {
            begin(place_of(level, cell), left_below(level - 1u, cell));
        }
        storageBarrier();
    }
    for (var level = LEVELS - 1u; level > 0u; level--) {
        let columns = LEVEL_COLUMNS[level];
        if level + 1u < LEVELS {
            for (var cell = local; cell < cells_of(level); cell += REDUCERS) {
                let parent = parent_of(level, cell % columns + 1u, cell / columns + 1u);
                coarse_value[place_of(level, cell)] += coarse_smoothed[parent];
            }
        }
        storageBarrier();
        for (var cell = local; cell < cells_of(level); cell += REDUCERS) {
            let place = place_of(level, cell);
            coarse_smoothed[place] = coarse_value[place] + smoothing(place) * left_at(place, columns + 2u);
        }
        storageBarrier();
    }
}
