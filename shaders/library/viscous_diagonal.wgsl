// The diagonal of the matrix of implicit viscosity, m^2, and the squares that its solve is judged by: of a residual and of the
// diagonal's product with a solution, both as velocities.

fn viscous_diagonal(i: u32) -> real {
    return volume[i] + clock[CLOCK_DIFFUSION] * diagonal[i];
}

fn viscous_squares(i: u32, residual: vector, solution: vector) -> vector {
    if i >= INTERIOR {
        return vector();
    }
    let left = residual / volume[i];
    let size = viscous_diagonal(i) / volume[i] * solution;
    return vector(dot(left, left), dot(size, size));
}
