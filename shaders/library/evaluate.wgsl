// The stored fit of point `j` at offset `d` from it: u_j + a0 x + a1 y + a2 x^2 + a3 xy + a4 y^2 + ..., (x, y) = d / r_e. m/s.

#import points
#import unrolled/monomials
#import unrolled/coefficients
#import unrolled/stored_fit

alias value = vector;

fn evaluate_offset(j: u32, d: vector, per: real) -> vector {
    return moving[j] + along(stored_fit(j), monomials(d * per));
}
