// Sums and maxima for a row of diagnostics, second half: over the workgroups.

#import total

var<workgroup> lane_maxima: array<vector, REDUCERS>;

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    var most = vector();
    for (var k = local; k < GROUPS; k += REDUCERS) {
        most = max(most, maxima[k]);
    }
    lane_maxima[local] = most;
    let sum = total(local, true);
    // The barriers of the sum stand between the writes and this.
    if local == 0u {
        for (var k = 1u; k < REDUCERS; k++) {
            most = max(most, lane_maxima[k]);
        }
        scalars[ENERGY] = sum.x;
        scalars[DIVERGENCE_SQUARE] = sum.y;
        scalars[SPEED_SQUARE] = most.x;
        scalars[CHANGE_SQUARE] = most.y;
    }
}
