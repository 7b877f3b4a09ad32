// The fits of the velocity under the forces alone, walls as mirrors of all of it but gravity's part.
//
// Shapes: the coefficients of u, then of v, blocked, m/s, scaled by the radius; (2.5) of the paper.

#import mirrored_fit
#import unrolled/store_fit

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        store_fit(i, fit_of(i, clock[CLOCK_KICK] * GRAVITY));
    }
}
