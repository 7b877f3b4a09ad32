// Counting sort of the points into cells, 3 of 7: adds up the counts of each tile of GROUP cells.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let tile = group_of(group);
    if local == 0u && tile < TILES {
        var sum = 0u;
        for (var cell = tile * GROUP; cell < min((tile + 1u) * GROUP, CELLS); cell++) {
            sum += atomicLoad(&tally[cell]);
        }
        tile_sums[tile] = sum;
    }
}
