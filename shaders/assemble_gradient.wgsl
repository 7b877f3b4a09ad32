// Rows of the fitted gradient: the factors of each neighbour's difference.
//
// Continuous: grad phi. Discrete: sum_j g_ij (phi_j - phi_i) = (a1, a2) / r_e of the fit; (2.6) of the paper. Units: 1/m.
// Shapes: CAPACITY entries a point along x, then along y, blocked.

#import fit_rows

alias value = vector;

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let per = real(1.0) / support[i];
    var unit = Coefficients();
    unit.a0 = vector(per, 0.0);
    unit.a1 = vector(0.0, per);
    let c = solve(i, unit);
    let first = at(i, 0u, CAPACITY);
    let along_x = at(i, 0u, 2u * CAPACITY);
    let along_y = at(i, CAPACITY, 2u * CAPACITY);
    let end = min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = 0u; slot < end; slot += BLOCK) {
        let factors = row_factor(neighbours[first + slot], here, per, c);
        gradient_row[along_x + slot] = factors.x;
        gradient_row[along_y + slot] = factors.y;
    }
}
