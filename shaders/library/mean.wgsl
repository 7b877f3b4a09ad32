// The weight of the integral form of MPS: w(r) = r_e / r - 1 below r_e, from the square of r / r_e; nothing for the point itself,
// which stands in unused slots.

fn mean_weight(square: real) -> real {
    return select(real(0.0), max(real(1.0) / sqrt(square) - real(1.0), real(0.0)), square > real(0.0));
}
