// Conjugate gradients, iteration 2 of 5: alpha = r z / d q.

#import conjugate_gradient_alpha
