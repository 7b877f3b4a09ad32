// BiCGStab, iteration 10 of 11: beta = (rho / rho before) (alpha / omega); whether to go on. A zero begins again from the
// residual at hand, with a new shadow.

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sum = total(local, live);
    if local == 0u && live && iterated(sum.x, sum.y) {
        let omega = scalars[OMEGA];
        if omega == real(0.0) || sum.z == real(0.0) {
            enter(PHASE_CHECKING);
        } else {
            scalars[BETA] = sum.z / scalars[RHO] * scalars[ALPHA] / omega;
            scalars[RHO] = sum.z;
        }
    }
}
