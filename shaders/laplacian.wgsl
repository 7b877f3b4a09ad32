// The Laplacian of a known field by the rows at hand.
//
// Continuous: lap phi. Discrete: sum_j l_ij (phi_j - phi_i). Units: 1/m^2.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let own = field[i];
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    var sum = real(0.0);
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += laplacian_row[slot] * (field[neighbours[slot]] - own);
    }
    field_laplacian[i] = sum;
}
