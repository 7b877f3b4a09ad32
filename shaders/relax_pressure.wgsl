// Moves the mean pressure towards the one found, less what viscosity left of a divergence: P += (p - P - rho nu d) / 2.
// Units: Pa.
//
// Source: the rotational form of incremental projection, Timmermans, Minev and van de Vosse, Int. J. Numer. Methods Fluids 22
// (1996) 673-688; the relaxation is ours.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        let before = mean_pressure[i];
        mean_pressure[i] = before + PRESSURE_RELAXATION * (pressure[i] - before - DYNAMIC_VISCOSITY * dilation[i]);
    }
}
