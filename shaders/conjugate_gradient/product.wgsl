// Conjugate gradients, iteration 1 of 5: q = K d, and the sum of d q over the points.

#import matrix
#import sums

fn unknown(i: u32) -> real {
    return direction[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var dq = real(0.0);
    if i < PADDED {
        let q = product_of(i);
        product[i] = q;
        dq = q * direction[i];
    }
    add_up_one(group_of(group), local, dq);
}
