// Rows, diagonal and source of the pressure equation of MPS; p = 0 at the surface, none behind the walls.
//
// Continuous: lap p = -relaxation (rho / dt^2) (n* - n0) / n0; (3.1) of the paper. Discrete, times lambda n0 / 2 D:
// sum_j w_ij (p_i - p_j) = relaxation (rho / dt^2) (lambda n0 / 2 D) (n*_i - n0) / n0; symmetric. Units: rows none, source Pa.

#import mirror
#import mean

var<private> inside: real;
var<private> sum: real;

fn visit(near: Neighbour) {
    let entry = select(real(0.0), inside * mean_weight(near.square), near.j < PRESSURED);
    matrix_row[near.slot] = entry;
    sum += entry;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let free = i >= PRESSURED || surface[i] != 0u;
    inside = select(real(1.0), real(0.0), free);
    sum = real(0.0);
    look_around(i);
    diagonal[i] = select(real(1.0), sum, sum > real(0.0));
    source[i] = select(clock[CLOCK_STIFFNESS] / PER_AREA * (crowding[i] - real(1.0)), real(0.0), free);
    if free {
        pressure[i] = real(0.0);
    }
}
