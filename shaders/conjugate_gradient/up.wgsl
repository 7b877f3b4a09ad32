// Conjugate gradients: the coarse pressure, the finest grid.

#import coarse_up
