// What the coarse pressure is at a point; nothing where the pressure is held.

fn coarse_at(i: u32) -> real {
    let place = coarse_cell[i];
    return select(real(0.0), coarse_smoothed[place], place != 0u);
}
