// A pressure solve begins, with a look at the residual.

#import control

@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) local: u32) {
    if running() {
        atomicStore(&control[OUTCOME], OUTCOME_CONVERGED);
        atomicStore(&control[ITERATIONS], 0u);
        atomicStore(&control[STARTS], 0u);
        enter(PHASE_CHECKING);
    }
}
