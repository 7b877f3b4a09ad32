// Source of the collocated pressure equation: the paper's (3.2).
//
// Continuous: lap p = (rho / dt) div u* inside, n . grad p = rho n . (u*_b - u_wall) / dt on walls.
// Discrete:   (rho / dt) (du/dx + dv/dy) by the gradient's rows; on walls scaled as the row is. Units: Pa/m^2.
// The paper prints -(rho / dt^2) grad u*: its units do not fit; the power of dt and the sign are misprints.

#import points
#import gradient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        let own = projected[i];
        let first = at(i, 0u, CAPACITY);
        let count = min(neighbour_count[i], CAPACITY);
        var sum = real(0.0);
        for (var slot = 0u; slot < count; slot++) {
            sum += dot(gradient_factors(i, slot), projected[neighbours[first + slot * BLOCK]] - own);
        }
        source[i] = clock[CLOCK_DENSITY_PER_KICK] * sum;
    } else if i < POINTS {
        let stopped = normal[i] * (projected[i] - velocity[i]);
        source[i] = row_scale[i] * clock[CLOCK_DENSITY_PER_KICK] * (stopped.x + stopped.y);
    }
}
