// How dense the points stand beside fits, weight (1 - (r/r_e)^2)^2, and what their surface is: those on one side, and spray, whose
// images behind a wall cover it and do not carry a fit.

const LATTICE_CROWD: real = FITTED_DENSITY;

fn crowd_weight(square: real) -> real {
    let rest = max(real(1.0) - square, real(0.0));
    return select(real(0.0), rest * rest, square > real(0.0));
}

fn is_free(count: u32, density: real, gap: bool) -> bool {
    return count < FEWEST || density < SURFACE_THIN || gap;
}
