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
    return rms(square) <= max(clock[CLOCK_STOP], STOP_FLOOR * EPSILON * rms(scale));
}

// A residual recomputed from the solution: the first one, and one after every stretch of iterations.
fn recomputed(square: real, scale: real) {
    let now = rms(square);
    let starts = atomicLoad(&control[STARTS]);
    let iterations = atomicLoad(&control[ITERATIONS]);
    if starts == 0u {
        scalars[FIRST_RESIDUAL] = now;
    }
    scalars[LAST_RESIDUAL] = now;
    if !finite(now) {
        atomicStore(&control[OUTCOME], OUTCOME_BROKE_DOWN);
    } else if reached(square, scale) {
        atomicStore(&control[OUTCOME], OUTCOME_CONVERGED);
    } else if starts > STOP_RESTARTS || iterations >= MAX_ITERATIONS {
        atomicStore(&control[OUTCOME], OUTCOME_STAGNATED);
    } else if atomicLoad(&control[OUTCOME]) == OUTCOME_CONVERGED {
        atomicStore(&control[STARTS], starts + 1u);
        scalars[BEST] = now;
        atomicStore(&control[SINCE_BEST], 0u);
        enter(PHASE_ITERATING);
        return;
    }
    enter(PHASE_IDLE);
    atomicAdd(&control[TOTAL_ITERATIONS], iterations);
    atomicMax(&control[MOST_ITERATIONS], iterations);
    atomicMax(&control[MOST_STARTS], starts);
    if atomicLoad(&control[OUTCOME]) != OUTCOME_CONVERGED {
        halt(HALTED_FOR_DIRECT_SOLVE);
    }
}

// A residual from the recurrence, after one more iteration; true to go on.
fn iterated(square: real, scale: real) -> bool {
    let iterations = atomicAdd(&control[ITERATIONS], 1u) + 1u;
    let now = rms(square);
    var since_best = 0u;
    if now < real(0.9) * scalars[BEST] {
        scalars[BEST] = now;
    } else {
        since_best = atomicLoad(&control[SINCE_BEST]) + 1u;
    }
    atomicStore(&control[SINCE_BEST], since_best);
    if !finite(now) {
        atomicStore(&control[OUTCOME], OUTCOME_BROKE_DOWN);
    } else if since_best >= STOP_PATIENCE {
        atomicStore(&control[OUTCOME], OUTCOME_STAGNATED);
    } else if !reached(square, scale) && iterations < MAX_ITERATIONS {
        return true;
    }
    enter(PHASE_CHECKING);
    return false;
}

fn break_down() {
    atomicStore(&control[OUTCOME], OUTCOME_BROKE_DOWN);
    enter(PHASE_CHECKING);
}
