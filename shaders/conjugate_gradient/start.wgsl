// Conjugate gradients, check 3 of 4: the mean is taken out of r, which the constants in the null space leave there;
// d = z = r / D. Sums over the points: r z, and the squares of r and of D p as densities.

#import density
#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let r = select(real(0.0), residual[i] - scalars[MEAN], i < POINTS);
        let z = r / diagonal[i];
        residual[i] = r;
        direction[i] = z;
        let square = density(i, r);
        let scale = density(i, diagonal[i] * pressure[i]);
        own = sums(r * z, square * square, scale * scale, 0.0);
    }
    add_up(group_of(group), local, own);
}
