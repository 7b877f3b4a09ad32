// Points whose normal matrix failed the pivot test step down the ladder: a wider radius, up to the cap; then fits of lower
// orders, down to the linear one; then the nearest value, which is no fit at all. Coefficients left out have zeros in their
// rows of the factor.

#import normal_matrix
#import search

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED || rung[i] != RUNG_FAILED {
        return;
    }
    if i >= POINTS {
        rung[i] = 0u;
        store_factor(i, Factor(), 0u);
        return;
    }
    let radius = support[i];
    var wider = WIDER;
    for (var k = 0u; k < WIDER_STEPS; k++) {
        let reached = radius * wider[k];
        let count = search(i, reached);
        if count > CAPACITY {
            break;
        }
        let f = factor_of(moments_of(i, reached, count));
        if least_pivot(f, ORDER) > PIVOT_THRESHOLD {
            keep(i, f, ORDER, reached, count, k + 1u);
            return;
        }
    }
    let count = min(search(i, radius), CAPACITY);
    let f = factor_of(moments_of(i, radius, count));
    var order = ORDER - 1u;
    while order > 0u && !(least_pivot(f, order) > PIVOT_THRESHOLD) {
        order--;
    }
    keep(i, f, order, radius, count, select(RUNG_NEAREST, RUNG_LINEAR + 1u - order, order > 0u));
}

fn keep(i: u32, f: Factor, order: u32, radius: real, count: u32, step: u32) {
    support[i] = radius;
    rung[i] = step;
    neighbour_count[i] = count;
    pad_slots(i, count, i);
    store_factor(i, f, order);
}
