// Counting sort of the points into cells, 1 of 7: forgets the counts.
// Shapes: `tally` one counter a cell and one more; `cell_start` likewise; `cell_points` one entry a point.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell <= CELLS {
        atomicStore(&tally[cell], 0u);
    }
}
