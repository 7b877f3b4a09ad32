// No mean of the pressure's kicks is kept.

fn mean_kick_of(i: u32) -> vector {
    return vector();
}
