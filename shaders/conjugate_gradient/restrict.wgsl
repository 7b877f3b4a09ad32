// Conjugate gradients: the coarse pressure, r summed up over the cells.

#import coarse_restrict

fn restricted(i: u32) -> real {
    return residual[i];
}
