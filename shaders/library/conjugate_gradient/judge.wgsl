// Conjugate gradients: r z of the first direction, with what a coarse pressure adds, where there is one; and whether to iterate.

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_CHECKING);
    let sum = total_with_coarse(local, live, equation() == EQUATION_PRESSURE);
    if local == 0u && live {
        scalars[RZ] = sum.x;
        recomputed(sum.y, sum.z);
    }
}
