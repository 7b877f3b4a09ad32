// Counting sort of the points into cells, 5 of 7: where each cell's points begin; the counters go back to zero.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let tile = group_of(group);
    if local == 0u && tile < TILES {
        var before = tile_sums[tile];
        for (var cell = tile * GROUP; cell < min((tile + 1u) * GROUP, CELLS); cell++) {
            cell_start[cell] = before;
            before += atomicExchange(&tally[cell], 0u);
        }
        if tile == TILES - 1u {
            cell_start[CELLS] = before;
        }
    }
}
