// BiCGStab, iteration 3 of 11: v = (A + c v 1^T / N) M^-1 d, and the sum of shadow v over the points.

#import matrix
#import shift_of
#import sums

fn unknown(i: u32) -> real {
    return preconditioned[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = real(0.0);
    if i < PADDED {
        let v = select(real(0.0), product_of(i) + shift_of(i), i < POINTS);
        product[i] = v;
        own = shadow[i] * v;
    }
    add_up_one(group_of(group), local, own);
}
