// BiCGStab, iteration 1 of 11: M^-1 d, d / D and, of points that move, the coarse pressure; its sum over the points.

#import sums
#import coarse_at

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = real(0.0);
    if i < PADDED {
        own = direction[i] / diagonal[i] + coarse_at(i);
        preconditioned[i] = own;
    }
    add_up_one(group_of(group), local, own);
}
