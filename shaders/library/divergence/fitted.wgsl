// Divergence of the projected velocity, 1/s: du/dx + dv/dy of its fit, (2.6) of the paper, at interior points.

#import fit

alias value = vector;

fn field(i: u32) -> value {
    return projected[i];
}

fn divergence_of(i: u32) -> real {
    if i >= INTERIOR {
        return real(0.0);
    }
    let a = fit(i);
    return (a.a0.x + a.a1.y) / support[i];
}
