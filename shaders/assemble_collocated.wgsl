// Rows of the collocated pressure matrix.
//
// Continuous: lap p inside, n . grad p on walls.
// Discrete:   m_ij the row of the Laplacian inside, that of the normal derivative on walls, with the sign and the size of the
// Laplacian's diagonal there. Units: 1/m^2.
// Shapes: CAPACITY entries a point, blocked; diagonal -sum_j m_ij, 1 in the padding.

#import points
#import gradient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let outward = normal[i];
    let first = at(i, 0u, CAPACITY);
    let count = min(neighbour_count[i], CAPACITY);
    let wall = i >= INTERIOR && i < POINTS;
    var scale = real(1.0);
    if wall {
        var sum = vector();
        for (var slot = 0u; slot < count; slot++) {
            sum += vector(laplacian_row[first + slot * BLOCK], dot(outward, gradient_factors(i, slot)));
        }
        scale = sum.x / sum.y;
    }
    var sum = real(0.0);
    for (var slot = 0u; slot < count; slot++) {
        let entry =
            select(laplacian_row[first + slot * BLOCK], scale * dot(outward, gradient_factors(i, slot)), wall);
        matrix_row[first + slot * BLOCK] = entry;
        sum += entry;
    }
    row_scale[i] = scale;
    diagonal[i] = select(real(1.0), -sum, i < POINTS);
}
