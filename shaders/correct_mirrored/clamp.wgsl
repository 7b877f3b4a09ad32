// Correction of points that move, 1 of 2: thin fluid does not pull; pressures below 0 become 0 where more than a share of the
// neighbours are on the surface. Pa.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED || !(pressure[i] < real(0.0)) {
        return;
    }
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    var free = 0u;
    for (var slot = first; slot < last; slot += BLOCK) {
        free += surface[neighbours[slot]];
    }
    if real(free) > SHEET * real((last - first) / BLOCK) {
        pressure[i] = real(0.0);
    }
}
