// BiCGStab: the coarse pressure, d summed up over the cells.

#import coarse_restrict

fn restricted(i: u32) -> real {
    return direction[i];
}
