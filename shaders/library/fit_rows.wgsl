// A derivative of the least-squares fit as a sum over neighbours: with (N^-1 c) from the normal equations, the factor of
// phi_j - phi_i is w_j (N^-1 c) . b_j, b = (x, y, x^2, xy, y^2, ...), (x, y) = d / r_e; (2.5), (2.6) of the paper.
// The file that imports this says how many derivatives there are side by side: `value`.

#import points
#import weight
#import normal_equations

fn row_factor(j: u32, here: vector, per: real, c: Coefficients) -> value {
    let d = (position[j] - here) * per;
    return weight(d.x * d.x + d.y * d.y) * along(c, monomials(d));
}
