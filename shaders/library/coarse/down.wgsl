// From the finest level to the next.

#import points
#import coarse_cycle

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell < cells_of(SECOND) {
        begin(place_of(SECOND, cell), left_below(FINEST, SECOND, cell));
    }
}
