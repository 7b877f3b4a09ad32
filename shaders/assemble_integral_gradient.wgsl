// Rows of the gradient in the integral form: the factors of each neighbour's difference.
//
// Continuous: grad phi. Discrete: (D / n0) d_ij / |d_ij|^2 w_ij; (2.3) of the paper. Units: 1/m.
// Shapes: CAPACITY entries a point along x, then along y, blocked.

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
    let along_x = at(i, 0u, 2u * CAPACITY);
    let along_y = at(i, CAPACITY, 2u * CAPACITY);
    let end = min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = 0u; slot < end; slot += BLOCK) {
        let d = (position[neighbours[first + slot]] - here) * per;
        let square = dot(d, d);
        let factor = DIMENSIONS / LATTICE_DENSITY * mean_weight(square) * per / select(real(1.0), square, square > real(0.0));
        gradient_row[along_x + slot] = factor * d.x;
        gradient_row[along_y + slot] = factor * d.y;
    }
}
