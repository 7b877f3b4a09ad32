// No coarse pressure.

fn coarse_at(i: u32) -> real {
    return real(0.0);
}
