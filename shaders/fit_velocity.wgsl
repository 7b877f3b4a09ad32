// The fits of the velocity that moves the points: (2.5) for u and for v.
//
// Shapes: the coefficients of u, then of v, blocked, m/s, scaled by the support radius.

#import fit
#import unrolled/store_fit

alias value = vector;

fn field(i: u32) -> value {
    return moving[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        store_fit(i, fit(i));
    }
}
