// The kick of the mean pressure by the fitted gradient.
//
// Discrete: G = (h / rho) sum_j g_ij (P_j - P_i) inside, the rows of `assemble_gradient`. Units: m/s.

#import points
#import gradient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let own = mean_pressure[i];
    let first = at(i, 0u, CAPACITY);
    let count = select(0u, min(neighbour_count[i], CAPACITY), i < INTERIOR);
    var sum = vector();
    for (var slot = 0u; slot < count; slot++) {
        sum += (mean_pressure[neighbours[first + slot * BLOCK]] - own) * gradient_factors(i, slot);
    }
    pressure_kick[i] = clock[CLOCK_CORRECTION] * sum;
}
