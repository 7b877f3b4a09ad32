// What the rank-one shift of BiCGStab adds to a row.

fn shift_of(i: u32) -> real {
    return select(real(0.0), scalars[CONSTANT], i < SHIFTED);
}
