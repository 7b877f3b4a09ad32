// The state of a batch of steps: what the host set going, what froze it, and where a solve stands.
//
// Every dispatch over points or cells takes its number of workgroups from `dispatches`; zeroed, it does nothing. A solve
// goes back and forth between two phases, recomputing the residual and iterating, and only the one it is in has
// workgroups. So a batch may hold any number of iterations, and its results do not depend on that number.

fn running() -> bool {
    return atomicLoad(&control[HALTED]) == HALTED_NOT;
}

fn in_phase(phase: u32) -> bool {
    return running() && atomicLoad(&control[PHASE]) == phase;
}

fn set_extent(slot: u32, extent: vec2<u32>) {
    dispatches[3u * slot] = extent.x;
    dispatches[3u * slot + 1u] = extent.y;
    dispatches[3u * slot + 2u] = 1u;
}

fn open_phase(phase: u32) {
    let none = vec2<u32>(0u, 0u);
    let one = vec2<u32>(1u, 1u);
    let checks = phase == PHASE_CHECKING;
    let iterates = phase == PHASE_ITERATING;
    set_extent(EXTENT_CHECK, select(none, POINTS_EXTENT, checks));
    set_extent(EXTENT_CHECK_ONCE, select(none, one, checks));
    set_extent(EXTENT_CHECK_CELLS, select(none, COARSE_EXTENT, checks));
    set_extent(EXTENT_CHECK_FOURS, select(none, FOURS_EXTENT, checks));
    set_extent(EXTENT_ITERATE, select(none, POINTS_EXTENT, iterates));
    set_extent(EXTENT_ITERATE_ONCE, select(none, one, iterates));
    set_extent(EXTENT_ITERATE_CELLS, select(none, COARSE_EXTENT, iterates));
    set_extent(EXTENT_ITERATE_FOURS, select(none, FOURS_EXTENT, iterates));
}

// A solve of this equation begins.
fn begin(equation: u32) {
    atomicStore(&control[EQUATION], equation);
    atomicStore(&control[OUTCOME + equation], OUTCOME_CONVERGED);
    atomicStore(&control[ITERATIONS + equation], 0u);
    atomicStore(&control[STARTS], 0u);
    enter(PHASE_CHECKING);
}

// The equation that is being solved: 0 the pressure's, 1 that of viscosity. Its words, scalars and times stand so many behind
// those of the pressure.
fn equation() -> u32 {
    return atomicLoad(&control[EQUATION]);
}

fn enter(phase: u32) {
    atomicStore(&control[PHASE], phase);
    open_phase(phase);
}

// Nothing of the batch runs any more; the phase of a solve is kept, for it to be taken up again.
fn halt(reason: u32) {
    atomicStore(&control[HALTED], reason);
    set_extent(EXTENT_POINTS, vec2<u32>(0u, 0u));
    set_extent(EXTENT_CELLS, vec2<u32>(0u, 0u));
    open_phase(PHASE_IDLE);
}
