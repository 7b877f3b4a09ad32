// The value of a known field in the integral form: its weighted mean over the neighbours.
//
// Continuous: phi(r) = integral of phi(r') delta(r' - r); (2.1) of the paper. Discrete: (1 / n0) sum_j phi_j w_ij; (2.2).

#import points
#import mean

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let per = real(1.0) / support[i];
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    var sum = real(0.0);
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = neighbours[slot];
        let d = (position[j] - here) * per;
        sum += mean_weight(dot(d, d)) * field[j];
    }
    field_average[i] = sum / LATTICE_DENSITY;
}
