// Takes the rows of outlets out of the collocated pressure matrix.
//
// Continuous: p = 0 at outlets. Discrete: an empty row, its source scaled by 0, with 1 on the diagonal.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR || i >= POINTS || outlet[i] == 0u {
        return;
    }
    let first = at(i, 0u, CAPACITY);
    for (var slot = 0u; slot < CAPACITY; slot++) {
        matrix_row[first + slot * BLOCK] = real(0.0);
    }
    row_scale[i] = real(0.0);
    diagonal[i] = real(1.0);
}
