// Entries of the collocated pressure equation are densities already, which the tolerance is in.

fn density(i: u32, value: real) -> real {
    return value;
}
