// Sums and maxima for a row of diagnostics, first half: over each workgroup's points.
//
// Sums: V |u|^2 / 2, m^4/s^2, and (div u)^2, 1/s^2. Maxima: |u|^2 and |u - u_reported|^2, m^2/s^2.

#import sums
#import divergence_of

var<workgroup> lane_maxima: array<vector, GROUP>;

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    var most = vector();
    if i < POINTS {
        let u = projected[i];
        let change = u - reported[i];
        let divergence = divergence_of(i);
        own = sums(real(0.5) * volume[i] * dot(u, u), divergence * divergence, 0.0, 0.0);
        most = vector(dot(u, u), dot(change, change));
    }
    lane_maxima[local] = most;
    add_up(group_of(group), local, own);
    // The barriers of the sum stand between the writes and this.
    if local == 0u && group_of(group) < GROUPS {
        for (var k = 1u; k < GROUP; k++) {
            most = max(most, lane_maxima[k]);
        }
        maxima[group_of(group)] = most;
    }
}
