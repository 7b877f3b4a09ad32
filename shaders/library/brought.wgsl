// What the fluid that arrives at point i brought along of a field: the fit of the nearest point, evaluated where the fluid came from.

#import points
#import space
#import unrolled/monomials
#import unrolled/coefficients
#import unrolled/stored_scalar_fit

alias value = real;

fn brought_to(i: u32) -> real {
    let j = departure_nearest[i];
    let d = shortest(departure[i] - position[j]) / support[j];
    return scalar_fit[at(j, 0u, 1u + COEFFICIENTS)] + along(stored_scalar_fit(j), monomials(d));
}
