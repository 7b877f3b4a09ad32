// Implicit viscosity, iteration 1 of 5: q = (V + h nu K) d, and the sum of d q over the points.

#import viscous_matrix
#import sums

fn unknown(i: u32) -> vector {
    return viscous_direction[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var dq = real(0.0);
    if i < PADDED {
        let q = viscous_row(i);
        viscous_product[i] = q;
        dq = dot(q, viscous_direction[i]);
    }
    add_up(group_of(group), local, sums(dq, 0.0, 0.0, 0.0));
}
