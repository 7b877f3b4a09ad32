// Implicit viscosity, check 2 of 2: whether to iterate.

#import conjugate_gradient_judge
