// An entry of MPS's pressure equation as one of the pressure's Laplacian, which the tolerance is in.

fn density(i: u32, value: real) -> real {
    return PER_AREA * value;
}
