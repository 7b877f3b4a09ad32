// Entries of the conservative pressure equation are integrals over cells: divided by the volume they are what the
// tolerance is in.

fn density(i: u32, integral: real) -> real {
    return integral * (real(1.0) / volume[i]);
}
