// Weight of a neighbour at scaled distance q = r / r_e: (1 - q^2)^4.

fn weight(scaled_square: real) -> real {
    let rest = max(real(1.0) - scaled_square, real(0.0));
    let square = rest * rest;
    return square * square;
}
