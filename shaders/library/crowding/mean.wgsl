// How dense the points stand, by MPS's weight, and what its surface is: too few around, and those on one side.

#import mean

const LATTICE_CROWD: real = LATTICE_DENSITY;

fn crowd_weight(square: real) -> real {
    return mean_weight(square);
}

fn is_free(count: u32, density: real, gap: bool) -> bool {
    return density < SURFACE_THRESHOLD && gap;
}
