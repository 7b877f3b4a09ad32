// Conjugate gradients, iteration 4 of 5: beta = r z / (r z before); whether to go on.

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sum = total_with_coarse(local, live);
    if local == 0u && live {
        scalars[BETA] = sum.x / scalars[RZ];
        scalars[RZ] = sum.x;
        iterated(sum.y, sum.z);
    }
}
