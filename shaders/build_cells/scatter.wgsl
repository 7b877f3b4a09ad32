// Counting sort of the points into cells, 6 of 7: puts each point into its cell, in whatever order they arrive.

#import points
#import cells

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS {
        let cell = cell_index(cell_of(position[i]));
        cell_points[cell_start[cell] + atomicAdd(&tally[cell], 1u)] = i;
    }
}
