// BiCGStab: the coarse pressure, s summed up over the cells.

#import coarse_restrict

fn restricted(i: u32) -> real {
    return stabilised[i];
}
