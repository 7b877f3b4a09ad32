// Watches the residual of a solve, as the CPU's `Monitor` does.
//
// Done when the root mean square of the residual, as a density, is below what the tolerance asks for or below some
// rounding units of the diagonal's product with the solution: it gets no smaller. `square` and `scale` are the sums of
// squares of the two. A residual is believed only when recomputed from the solution.

#import control
#import finite

fn rms(square: real) -> real {
    return sqrt(square / real(POINTS));
}

fn reached(square: real, scale: real) -> bool {
    let viscous = equation() == EQUATION_VISCOSITY;
    let floor = select(STOP_FLOOR, VISCOUS_FLOOR, viscous);
    return rms(square) <= max(clock[CLOCK_STOP + equation()], floor * EPSILON * rms(scale));
}

fn most_iterations() -> u32 {
    return select(MAX_ITERATIONS, VISCOUS_ITERATIONS_ALLOWED, equation() == EQUATION_VISCOSITY);
}

// A residual recomputed from the solution: the first one, and one after every stretch of iterations.
fn recomputed(square: real, scale: real) {
    let behind = equation();
    let now = rms(square);
    let starts = atomicLoad(&control[STARTS]);
    let iterations = atomicLoad(&control[ITERATIONS + behind]);
    if starts == 0u {
        scalars[FIRST_RESIDUAL + behind] = now;
    }
    scalars[LAST_RESIDUAL + behind] = now;
    if !finite(now) {
        atomicStore(&control[OUTCOME + behind], OUTCOME_BROKE_DOWN);
    } else if reached(square, scale) {
        atomicStore(&control[OUTCOME + behind], OUTCOME_CONVERGED);
    } else if starts > STOP_RESTARTS || iterations >= most_iterations() {
        atomicStore(&control[OUTCOME + behind], OUTCOME_STAGNATED);
    } else if atomicLoad(&control[OUTCOME + behind]) == OUTCOME_CONVERGED {
        atomicStore(&control[STARTS], starts + 1u);
        scalars[BEST] = now;
        atomicStore(&control[SINCE_BEST], 0u);
        enter(PHASE_ITERATING);
        return;
    }
    enter(PHASE_IDLE);
    atomicAdd(&control[TOTAL_ITERATIONS + behind], iterations);
    atomicMax(&control[MOST_ITERATIONS + behind], iterations);
    atomicMax(&control[MOST_STARTS + behind], starts);
    if atomicLoad(&control[OUTCOME + behind]) != OUTCOME_CONVERGED {
        halt(HALTED_FOR_DIRECT_SOLVE);
    }
}

// A residual from the recurrence, after one more iteration; true to go on.
fn iterated(square: real, scale: real) -> bool {
    let behind = equation();
    let iterations = atomicAdd(&control[ITERATIONS + behind], 1u) + 1u;
    let now = rms(square);
    var since_best = 0u;
    if now < real(0.9) * scalars[BEST] {
        scalars[BEST] = now;
    } else {
        since_best = atomicLoad(&control[SINCE_BEST]) + 1u;
    }
    atomicStore(&control[SINCE_BEST], since_best);
    if !finite(now) {
        atomicStore(&control[OUTCOME + behind], OUTCOME_BROKE_DOWN);
    } else if since_best >= STOP_PATIENCE {
        atomicStore(&control[OUTCOME + behind], OUTCOME_STAGNATED);
    } else if !reached(square, scale) && iterations < most_iterations() {
        return true;
    }
    enter(PHASE_CHECKING);
    return false;
}

fn break_down() {
    atomicStore(&control[OUTCOME + equation()], OUTCOME_BROKE_DOWN);
    enter(PHASE_CHECKING);
}
