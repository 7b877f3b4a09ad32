// Correction of MPS, 2 of 2: u' = u* - (dt / rho) (D / n0) sum_j (p_j - p_min) d / |d|^2 w, and the way dt (u' - u*).
//
// p_min is the least pressure around the point, its own among them, which keeps points from clumping. Units: m/s, m.

#import mirror
#import mean

var<private> pass_two: bool;
var<private> least: real;
var<private> sum: vector;

fn visit(near: Neighbour) {
    if near.j >= PRESSURED {
        return;
    }
    if !pass_two {
        least = min(least, pressure[near.j]);
    } else if near.square > real(0.0) {
        sum += (pressure[near.j] - least) * mean_weight(near.square) / near.square * near.offset;
    }
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    least = pressure[i];
    pass_two = false;
    look_around(i);
    sum = vector();
    pass_two = true;
    look_around(i);
    let change = -clock[CLOCK_CORRECTION] * DIMENSIONS / LATTICE_DENSITY / RADIUS * sum;
    projected[i] += change;
    displacement[i] = clock[CLOCK_DT] * change;
}
