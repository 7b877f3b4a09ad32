// Points whose normal matrix failed the pivot test step down the ladder: a wider radius, up to the cap; then the linear
// fit; then the nearest value, which is no fit at all. Coefficients left out have zeros in their rows of the factor.

#import normal_matrix
#import search

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED || rung[i] != RUNG_FAILED {
        return;
    }
    var f = Factor();
    if i >= POINTS {
        rung[i] = 0u;
        store_factor(i, f);
        return;
    }
    let radius = support[i];
    var wider = WIDER;
    var reached = radius;
    var step = 0u;
    var count = 0u;
    for (var k = 0u; k < WIDER_STEPS; k++) {
        reached = radius * wider[k];
        count = search(i, reached);
        if count > CAPACITY {
            break;
        }
        f = factor_of(moments_of(i, reached, count));
        if f.least > PIVOT_THRESHOLD {
            step = k + 1u;
            break;
        }
    }
    if step == 0u {
        reached = radius;
        count = min(search(i, radius), CAPACITY);
        let m = moments_of(i, radius, count);
        // The factor of a singular matrix is rubbish; its second pivot tells.
        var second = real(0.0);
        if m.xx > real(0.0) {
            second = m.yy - m.xy * m.xy / m.xx;
        }
        f = Factor();
        if m.xx > real(0.0) && second > PIVOT_THRESHOLD * m.yy {
            step = RUNG_LINEAR;
            f.l00 = reciprocal_root(m.xx);
            f.l10 = m.xy * f.l00;
            f.l11 = reciprocal_root(m.yy - f.l10 * f.l10);
        } else {
            step = RUNG_NEAREST;
        }
    }
    support[i] = reached;
    rung[i] = step;
    neighbour_count[i] = count;
    pad_slots(i, count, i);
    store_factor(i, f);
}
