// Conjugate gradients, check 4 of 4: whether to iterate.

#import conjugate_gradient_judge
