// The pressure equation, solved on the host with a factorisation made once: the batch waits for it.

#import control

@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) local: u32) {
    if running() {
        atomicStore(&control[EQUATION], EQUATION_PRESSURE);
        atomicStore(&control[OUTCOME], OUTCOME_CONVERGED);
        atomicStore(&control[ITERATIONS], 0u);
        halt(HALTED_FOR_DIRECT_SOLVE);
    }
}
