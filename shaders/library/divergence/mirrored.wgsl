// Divergence of the velocity of points that move, 1/s: du/dx + dv/dy of its fit, walls as mirrors; nothing at the surface.

#import mirrored_fit

fn divergence_of(i: u32) -> real {
    if i >= INTERIOR || surface[i] != 0u {
        return real(0.0);
    }
    let a = fit_of(i, vector());
    return (a.a0.x + a.a1.y) / RADIUS;
}
