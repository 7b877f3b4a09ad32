// The normal equations of one point's least squares: their right sides, and L L^T a = b solved through the stored factor.
//
// Shapes: FACTOR numbers a point, blocked: l00, l10, l11, ..., reciprocals on the diagonal.
// The file that imports this says what is fitted: `value`, a number or a vector of numbers side by side.

#import points
#import unrolled/monomials
#import unrolled/coefficients
#import unrolled/solve
