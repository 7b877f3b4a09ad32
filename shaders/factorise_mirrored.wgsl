// The normal matrix of every point that moves, factorised, walls as mirrors: (2.5) of the paper.
//
// A point whose matrix is too weak, and one of the surface, keeps the linear fit; one whose neighbours stand in a line none.

#import mirror
#import normal_matrix

var<private> moments: Moments;

fn visit(near: Neighbour) {
    moments = add_moments(moments, near.offset, weight(near.square));
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    moments = Moments();
    look_around(i);
    let f = factor_of(moments);
    var order = ORDER;
    if surface[i] != 0u || !(least_pivot(f, ORDER) > MOVING_PIVOT) {
        let spread = least_pivot(f, 1u) * min(moments.m0, moments.m2);
        order = select(0u, 1u, spread > SPREAD * max(moments.m0, moments.m2));
    }
    store_factor(i, f, order);
    rung[i] = select(select(RUNG_NEAREST, RUNG_LINEAR, order == 1u), 0u, order == ORDER);
}
