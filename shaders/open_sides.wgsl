// The velocity on slip sides and at outlets, from the fluid before them.
//
// Continuous: d u / dn = 0, and n . u = 0 on slip sides. Discrete: v = sum_j s_ij u_j, u_i = v - n_i (n_i . v). Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR || i >= POINTS || open_count[i] == 0u {
        return;
    }
    let first = at(i, 0u, OPEN_CAPACITY);
    let last = first + min(open_count[i], OPEN_CAPACITY) * BLOCK;
    var sum = vector();
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += open_row[slot] * followed[open_points[slot]];
    }
    followed[i] = sum - dot(open_normal[i], sum) * open_normal[i];
}
