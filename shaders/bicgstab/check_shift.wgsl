// BiCGStab, check 2 of 4: what the shift adds to a row, c (1 . p) / N.

#import control
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_CHECKING);
    let sum = total(local, live);
    if local == 0u && live {
        scalars[CONSTANT] = SHIFT_PER_POINT * sum.x;
    }
}
