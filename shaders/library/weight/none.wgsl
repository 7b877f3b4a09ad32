// Weight of a neighbour: 1, the paper's.

fn weight(scaled_square: real) -> real {
    return real(1.0);
}
