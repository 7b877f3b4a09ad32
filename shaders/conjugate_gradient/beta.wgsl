// Conjugate gradients, iteration 4 of 5: beta = r z / (r z before); whether to go on.

#import conjugate_gradient_beta
