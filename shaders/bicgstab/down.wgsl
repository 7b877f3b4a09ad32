// BiCGStab: the coarse pressure, from the finest grid to the next.

#import coarse_down
