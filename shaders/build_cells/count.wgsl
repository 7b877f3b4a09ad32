// Counting sort of the points into cells, 2 of 7: counts the points of each cell.

#import points
#import cells

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS {
        atomicAdd(&tally[cell_index(cell_of(position[i]))], 1u);
    }
}
