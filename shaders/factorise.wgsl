// The normal matrix of every point, factorised: (2.5) of the paper.
//
// A point whose least pivot falls below the threshold is marked FAILED, and left to `widen_support`.

#import normal_matrix

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let f = factor_of(moments_of(i, support[i], neighbour_count[i]));
    store_factor(i, f, ORDER);
    rung[i] = select(RUNG_FAILED, 0u, least_pivot(f, ORDER) > PIVOT_THRESHOLD);
}
