// BiCGStab, iterations 2 and 6 of 11: what the shift adds to a row of the next product.

#import control
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sum = total(local, live);
    if local == 0u && live {
        scalars[CONSTANT] = SHIFT_PER_POINT * sum.x;
    }
}
