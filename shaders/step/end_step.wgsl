// A step is done. A field that is not a number, or a neighbour list that did not hold its points, ends the batch.

#import control

@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) local: u32) {
    if running() {
        atomicAdd(&control[STEPS], 1u);
        if atomicLoad(&control[MOST_NEIGHBOURS]) > 0u {
            halt(HALTED_BY_OVERFLOW);
        } else if min(min(atomicLoad(&control[BAD_VELOCITY]), atomicLoad(&control[BAD_PRESSURE])), atomicLoad(&control[BAD_CARRIED])) != NO_POINT {
            halt(HALTED_BY_NON_FINITE);
        }
    }
}
