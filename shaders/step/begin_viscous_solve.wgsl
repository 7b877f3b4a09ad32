// A solve of implicit viscosity begins, with a look at the residual.

#import control

@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) local: u32) {
    if running() {
        begin(EQUATION_VISCOSITY);
    }
}
