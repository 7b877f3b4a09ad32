// The iterations that a batch holds for a solve end here. One that is not done freezes the batch: the host takes it up again.

#import control

@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) local: u32) {
    if running() && atomicLoad(&control[PHASE]) != PHASE_IDLE {
        halt(HALTED_IN_SOLVE);
    }
}
