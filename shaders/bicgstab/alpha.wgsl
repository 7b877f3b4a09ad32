// BiCGStab, iteration 4 of 11: alpha = rho / (shadow v).

#import monitor
#import total

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let live = in_phase(PHASE_ITERATING);
    let sv = total(local, live).x;
    if local == 0u && live {
        if sv == real(0.0) || scalars[RHO] == real(0.0) || !finite(sv) {
            break_down();
        } else {
            scalars[ALPHA] = scalars[RHO] / sv;
        }
    }
}
