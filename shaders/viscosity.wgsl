// Viscosity, added to the kick.
//
// Continuous: du/dt = nu lap u.
// Discrete:   kick += dt nu sum_j l_ij (u_j - u_i), the rows of `assemble_laplacian`. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= FORCED {
        return;
    }
    let own = diffused[i];
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    var sum = vector();
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += laplacian_row[slot] * (diffused[neighbours[slot]] - own);
    }
    kick[i] += clock[CLOCK_DIFFUSION] * sum;
}
