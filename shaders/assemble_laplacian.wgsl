// Rows of the fitted Laplacian: the factor of each neighbour's difference.
//
// Continuous: lap phi. Discrete: sum_j l_ij (phi_j - phi_i) = 2 (a3 + a5) / r_e^2 of the fit; (2.6) of the paper. Units: 1/m^2.
// Shapes: CAPACITY entries a point, blocked, as the neighbours.

#import fit_rows

alias value = real;

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let per = real(1.0) / support[i];
    var unit = Coefficients();
    unit.a2 = real(2.0) * per * per;
    unit.a4 = unit.a2;
    let c = solve(i, unit);
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        laplacian_row[slot] = row_factor(neighbours[slot], here, per, c);
    }
}
