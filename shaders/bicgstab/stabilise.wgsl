// BiCGStab, iteration 5 of 11: p += alpha M^-1 d, s = r - alpha v, s / D, and its sum over the points.

#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = real(0.0);
    if i < PADDED {
        pressure[i] += scalars[ALPHA] * preconditioned[i];
        let s = residual[i] - scalars[ALPHA] * product[i];
        stabilised[i] = s;
        own = s / diagonal[i];
        preconditioned[i] = own;
    }
    add_up_one(group_of(group), local, own);
}
