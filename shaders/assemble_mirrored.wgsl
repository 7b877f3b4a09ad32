// Rows, diagonal and source of the pressure equation of points that move, by fits; p = 0 at the surface.
//
// Continuous: lap p = (rho / dt) div u* - relaxation (rho / dt^2) (c - 1); (3.2) of the paper, and the density c over a lattice's.
// Discrete: rows of the fitted Laplacian over neighbours and images, (2.6), or, where too many of their entries have the wrong
// sign, those of the weighted mean, (2.4). An image's pressure is rho g . way more than its point's.
// Units: rows 1/m^2, source Pa/m^2.

#import mirror
#import weight
#import mean
#import normal_equations
#import stored_coefficient

alias value = real;

var<private> pass_two: bool;
var<private> c: Coefficients;
var<private> wrong: real;
var<private> right: real;
var<private> fitted: real;
var<private> mean_share: real;
var<private> inside: real;
var<private> sum: real;
var<private> offset: real;
var<private> shore: bool;

fn visit(near: Neighbour) {
    let entry = weight(near.square) * along(c, monomials(near.offset));
    if !pass_two {
        wrong += max(-entry, real(0.0));
        right += max(entry, real(0.0));
        return;
    }
    let part = inside * (fitted * entry + mean_share * mean_weight(near.square));
    if near.flip.x > real(0.0) && near.flip.y > real(0.0) {
        matrix_row[near.slot] = part;
        shore = shore || surface[near.j] != 0u;
    } else {
        offset += part * dot(DENSITY * GRAVITY, near.way);
        if near.slot != OWN {
            matrix_row[near.slot] += part;
        }
    }
    if near.slot != OWN {
        sum += part;
    }
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    var unit = Coefficients();
    unit.a2 = real(2.0) / (RADIUS * RADIUS);
    unit.a4 = unit.a2;
    c = solve(i, unit);
    wrong = real(0.0);
    right = real(0.0);
    pass_two = false;
    look_around(i);
    fitted = select(real(0.0), real(1.0), WRONG_SIGN * right > wrong);
    mean_share = (real(1.0) - fitted) * PER_AREA;
    inside = select(real(1.0), real(0.0), surface[i] != 0u);
    sum = real(0.0);
    offset = real(0.0);
    shore = false;
    pass_two = true;
    look_around(i);
    let divergence = (stored_coefficient(i, 0u).x + stored_coefficient(i, 1u).y) / RADIUS;
    var excess = crowding[i] - real(1.0);
    // Beside the surface a density below the lattice's is no error.
    if shore {
        excess = max(excess, real(0.0));
    }
    let flow = clock[CLOCK_DENSITY_PER_KICK] * divergence - clock[CLOCK_STIFFNESS] * excess;
    // No Laplacian that a pressure could answer to: as free as the surface.
    let free = -sum >= real(0.0);
    diagonal[i] = select(-sum, real(1.0), free);
    source[i] = select(inside * (flow - offset), real(0.0), free);
    if free {
        pressure[i] = real(0.0);
        let first = at(i, 0u, CAPACITY);
        for (var slot = first; slot < first + CAPACITY * BLOCK; slot += BLOCK) {
            matrix_row[slot] = real(0.0);
        }
    }
}
