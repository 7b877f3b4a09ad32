// The gradient of a known field by the rows at hand.
//
// Continuous: grad phi. Discrete: sum_j g_ij (phi_j - phi_i). Units: 1/m.

#import points
#import gradient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let own = field[i];
    let first = at(i, 0u, CAPACITY);
    let count = min(neighbour_count[i], CAPACITY);
    var sum = vector();
    for (var slot = 0u; slot < count; slot++) {
        sum += (field[neighbours[first + slot * BLOCK]] - own) * gradient_factors(i, slot);
    }
    field_gradient[i] = sum;
}
