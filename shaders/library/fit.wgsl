// Least-squares fit of one field at one point.
//
// Continuous: phi(x) ~ phi_i + grad phi . d + (1/2) d . H d + ...
// Discrete:   phi_j - phi_i = a0 x + a1 y + a2 x^2 + a3 xy + a4 y^2 + ..., (x, y) = d / r_e, weighted by w(r): the paper's (2.5).
// The file that imports this says what is fitted: `value`, the type, and `field`, the value at a point.

#import points
#import weight
#import normal_equations

fn fit(i: u32) -> Coefficients {
    let here = position[i];
    let per = real(1.0) / support[i];
    let own = field(i);
    var sum = Coefficients();
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = neighbours[slot];
        let d = (position[j] - here) * per;
        sum = add_term(sum, monomials(d), weight(d.x * d.x + d.y * d.y) * (field(j) - own));
    }
    return solve(i, sum);
}
