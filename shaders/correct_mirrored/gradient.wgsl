// Correction of points that move, 2 of 2: u' = u* - (dt / rho) grad p, and the way dt (u' - u*).
//
// Discrete: the gradient of the fit, walls as mirrors; (2.6) of the paper. Units: m/s, m.

#import mirror
#import weight
#import normal_equations

alias value = real;

var<private> right: Coefficients;
var<private> own: real;

fn visit(near: Neighbour) {
    let there = pressure[near.j] + dot(DENSITY * GRAVITY, near.way);
    right = add_term(right, monomials(near.offset), weight(near.square) * (there - own));
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    right = Coefficients();
    own = pressure[i];
    look_around(i);
    let fitted = solve(i, right);
    let change = -clock[CLOCK_CORRECTION] / RADIUS * vector(fitted.a0, fitted.a1);
    projected[i] += change;
    displacement[i] = clock[CLOCK_DT] * change;
}
