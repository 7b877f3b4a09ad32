// Conjugate gradients, check 2 of 4: the mean of r, where the matrix has the constants in its null space.

#import control
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_CHECKING);
    let sum = total(local, live);
    if local == 0u && live {
        scalars[MEAN] = select(real(0.0), sum.x / real(POINTS), SINGULAR);
    }
}
