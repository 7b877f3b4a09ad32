// Divergence of the projected velocity, 1/s: the volume flux out of a cell over its volume.

#import face_flux
#import wall_flux_of

fn divergence_of(i: u32) -> real {
    return (face_flux(i) + wall_flux_of(i)) / volume[i];
}
