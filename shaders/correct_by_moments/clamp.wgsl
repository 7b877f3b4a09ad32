// Corrected correction of MPS, 1 of 2: fluid does not pull.

#import clamp
