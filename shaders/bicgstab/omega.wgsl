// BiCGStab, iteration 8 of 11: omega = t s / t t; zero where the first half of the iteration has already arrived.

#import control
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sum = total(local, live);
    if local == 0u && live {
        var omega = real(0.0);
        if sum.y > real(0.0) {
            omega = sum.x / sum.y;
        }
        scalars[OMEGA] = omega;
    }
}
