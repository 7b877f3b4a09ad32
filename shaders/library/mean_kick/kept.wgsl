// The relaxed mean of the pressure's kicks, m/s.

fn mean_kick_of(i: u32) -> vector {
    return pressure_kick[i];
}
