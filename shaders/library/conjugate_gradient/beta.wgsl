// Conjugate gradients: beta = r z / (r z before), and whether to go on; r z with what a coarse pressure adds, where there is one.

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sum = total_with_coarse(local, live, equation() == EQUATION_PRESSURE);
    if local == 0u && live {
        scalars[BETA] = sum.x / scalars[RZ];
        scalars[RZ] = sum.x;
        iterated(sum.y, sum.z);
    }
}
