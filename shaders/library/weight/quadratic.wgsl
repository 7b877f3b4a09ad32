// Weight of a neighbour at scaled distance q = r / r_e: (1 - q)^2.

fn weight(scaled_square: real) -> real {
    let rest = max(real(1.0) - sqrt(scaled_square), real(0.0));
    return rest * rest;
}
