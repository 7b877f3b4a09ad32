// Conjugate gradients: the coarse pressure, the grids above the finest.

#import coarse_coarser
