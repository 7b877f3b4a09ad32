// BiCGStab, iteration 7 of 11: t = (A + c v 1^T / N) M^-1 s, and the sums of t s and t t over the points.

#import matrix
#import shift_of
#import sums

fn unknown(i: u32) -> real {
    return preconditioned[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let t = select(real(0.0), product_of(i) + shift_of(i), i < POINTS);
        stabilised_product[i] = t;
        own = sums(t * stabilised[i], t * t, 0.0, 0.0);
    }
    add_up(group_of(group), local, own);
}
