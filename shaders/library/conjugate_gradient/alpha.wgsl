// Conjugate gradients: alpha = r z / d q.

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let dq = total(local, live).x;
    if local == 0u && live {
        if dq <= real(0.0) || !finite(dq) {
            break_down();
        } else {
            scalars[ALPHA] = scalars[RZ] / dq;
        }
    }
}
