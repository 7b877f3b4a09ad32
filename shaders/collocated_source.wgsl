// Source of the collocated pressure equation: the paper's (3.2).
//
// Continuous: lap p = (rho / dt) div u* inside, n . grad p = rho n . (u*_b - u_wall) / dt on walls.
// Discrete:   (rho / dt) (du/dx + dv/dy) of the fit (2.5); on walls scaled as the row is. Units: Pa/m^2.
// The paper prints -(rho / dt^2) grad u*: its units do not fit; the power of dt and the sign are misprints.

#import fit

alias value = vector;

fn field(i: u32) -> value {
    return projected[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        let a = fit(i);
        source[i] = clock[CLOCK_DENSITY_PER_KICK] * a.per * (a.a1.x + a.a2.y);
    } else if i < POINTS {
        let stopped = normal[i] * (projected[i] - velocity[i]);
        source[i] = row_scale[i] * clock[CLOCK_DENSITY_PER_KICK] * (stopped.x + stopped.y);
    }
}
