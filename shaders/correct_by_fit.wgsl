// Correction by the fitted gradient.
//
// Continuous: u' = u* - (dt / rho) grad p.
// Discrete:   grad p = sum_j g_ij (p_j - p_i), the rows of `assemble_gradient`. Units: m/s.

#import points
#import gradient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let own = pressure[i];
    let first = at(i, 0u, CAPACITY);
    let count = min(neighbour_count[i], CAPACITY);
    var sum = vector();
    for (var slot = 0u; slot < count; slot++) {
        sum += (pressure[neighbours[first + slot * BLOCK]] - own) * gradient_factors(i, slot);
    }
    projected[i] += -clock[CLOCK_CORRECTION] * sum;
}
