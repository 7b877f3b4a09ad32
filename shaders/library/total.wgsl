// The second half of a sum over the points: one workgroup adds up the partial sums, in a fixed order.

var<workgroup> lane_totals: array<sums, REDUCERS>;
var<workgroup> row_totals: array<sums, REDUCER_ROWS>;

// The sums, on invocation 0. Every invocation calls it; `live` false skips the work.
fn total(local: u32, live: bool) -> sums {
    return total_of(local, select(0u, GROUPS, live));
}

// The same with what the cells of a coarse pressure add.
fn total_with_coarse(local: u32, live: bool, pressure: bool) -> sums {
    let end = GROUPS + select(0u, COARSE_GROUPS, pressure);
    return total_of(local, select(0u, end, live));
}

fn total_of(local: u32, end: u32) -> sums {
    var own = sums();
    for (var k = local; k < end; k += REDUCERS) {
        own += partials[k];
    }
    lane_totals[local] = own;
    workgroupBarrier();
    var sum = sums();
    if local < REDUCER_ROWS {
        for (var k = 0u; k < REDUCERS / REDUCER_ROWS; k++) {
            sum += lane_totals[local * (REDUCERS / REDUCER_ROWS) + k];
        }
        row_totals[local] = sum;
    }
    workgroupBarrier();
    sum = sums();
    if local == 0u {
        for (var k = 0u; k < REDUCER_ROWS; k++) {
            sum += row_totals[k];
        }
    }
    return sum;
}
