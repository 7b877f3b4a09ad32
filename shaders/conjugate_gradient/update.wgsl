// Conjugate gradients, iteration 3 of 5: p += alpha d, r -= alpha q.
// Sums over the points: r z, z = r / D, and the squares of r and of D p as densities.

#import density
#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let alpha = scalars[ALPHA];
        let p = pressure[i] + alpha * direction[i];
        let r = residual[i] - alpha * product[i];
        pressure[i] = p;
        residual[i] = r;
        let square = density(i, r);
        let scale = density(i, diagonal[i] * p);
        own = sums(r * r / diagonal[i], square * square, scale * scale, 0.0);
    }
    add_up(group_of(group), local, own);
}
