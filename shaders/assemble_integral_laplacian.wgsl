// Rows of the Laplacian in the integral form: the factor of each neighbour's difference.
//
// Continuous: lap phi. Discrete: (2 D / (lambda n0)) w_ij; (2.4) of the paper. Units: 1/m^2.
// Shapes: CAPACITY entries a point, blocked, as the neighbours.

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
    for (var slot = first; slot < last; slot += BLOCK) {
        let d = (position[neighbours[slot]] - here) * per;
        laplacian_row[slot] = real(2.0) * DIMENSIONS / (LATTICE_SPREAD * LATTICE_DENSITY) * mean_weight(dot(d, d));
    }
}
