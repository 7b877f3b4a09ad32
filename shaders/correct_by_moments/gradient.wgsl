// Corrected correction of MPS, 2 of 2: u' = u* - (dt / rho) C^-1 (D / n0) sum_j (p_j - p_min) d / |d|^2 w, and the way dt (u' - u*).
//
// C = (D / n0) sum_j d d^T / |d|^2 w, the identity on a full lattice; where its determinant is small it is left out. Units: m/s, m.

#import least

var<private> moments: array<real, 3>;

fn count(offset: vector, factor: real) {
    let scaled = DIMENSIONS / LATTICE_DENSITY * factor;
    moments[0] += scaled * offset.x * offset.x;
    moments[1] += scaled * offset.x * offset.y;
    moments[2] += scaled * offset.y * offset.y;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    moments = array<real, 3>();
    let plain = mean_above_least(i);
    let xx = moments[0];
    let xy = moments[1];
    let yy = moments[2];
    let determinant = xx * yy - xy * xy;
    if determinant > LEAST_DETERMINANT {
        correct(i, vector(yy * plain.x - xy * plain.y, xx * plain.y - xy * plain.x) / determinant);
    } else {
        correct(i, plain);
    }
}
