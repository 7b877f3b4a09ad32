// Rows of the collocated pressure matrix.
//
// Continuous: lap p inside, n . grad p on walls.
// Discrete:   m_ij = w_ij c . b(d_ij), b = (x, y, x^2, xy, y^2), c from the normal equations for the Laplacian (2.6) or for the
// normal derivative; a wall's row has the sign and the size of the Laplacian's diagonal there. Units: 1/m^2.
// Shapes: CAPACITY entries a point, blocked; diagonal -sum_j m_ij, 1 in the padding.

#import points
#import weight
#import normal_equations

// Of the Laplacian and of the normal derivative, side by side.
alias value = vector;

struct Neighbour {
    weight: real,
    rows: vector,
}

fn neighbour_at(slot: u32, here: vector, per: real, c: Coefficients) -> Neighbour {
    let d = (position[neighbours[slot]] - here) * per;
    let rows = c.a1 * d.x + c.a2 * d.y + c.a3 * (d.x * d.x) + c.a4 * (d.x * d.y) + c.a5 * (d.y * d.y);
    return Neighbour(weight(d.x * d.x + d.y * d.y), rows);
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let per = real(1.0) / support[i];
    let n = normal[i] * per;
    let second = vector(real(2.0) * per * per, 0.0);
    let c = solve(i, Coefficients(vector(0.0, n.x), vector(0.0, n.y), second, vector(), second));
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    let wall = i >= INTERIOR && i < POINTS;
    var scale = real(1.0);
    if wall {
        var sum = vector();
        for (var slot = first; slot < last; slot += BLOCK) {
            let neighbour = neighbour_at(slot, here, per, c);
            sum += neighbour.weight * neighbour.rows;
        }
        scale = sum.x / sum.y;
    }
    var sum = real(0.0);
    for (var slot = first; slot < last; slot += BLOCK) {
        let neighbour = neighbour_at(slot, here, per, c);
        let entry = neighbour.weight * select(neighbour.rows.x, scale * neighbour.rows.y, wall);
        matrix_row[slot] = entry;
        sum += entry;
    }
    row_scale[i] = scale;
    diagonal[i] = select(real(1.0), -sum, i < POINTS);
}
