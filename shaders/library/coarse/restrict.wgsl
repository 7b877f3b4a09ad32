// A residual summed up over the cells. The file that imports this says which: `restricted`, its value at a point.

#import points
#import coarse_cycle

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell < CELLS {
        var sum = real(0.0);
        for (var k = cell_start[cell]; k < cell_start[cell + 1u]; k++) {
            sum += restricted(cell_points[k]);
        }
        begin(place_of(FINEST, cell), sum);
    }
}
