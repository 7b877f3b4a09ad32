// Conjugate gradients, check 1 of 4: r = b - K p, and the sum of r over the points.

#import matrix
#import sums

fn unknown(i: u32) -> real {
    return pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var r = real(0.0);
    if i < PADDED {
        r = source[i] - product_of(i);
        residual[i] = r;
    }
    add_up_one(group_of(group), local, r);
}
