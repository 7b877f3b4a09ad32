// Self-test: counts one by one. Mesa's lavapipe before 23 leaves a loop after 65,535 rounds, without an error.

@group(0) @binding(0) var<storage, read_write> counted: array<u32>;

@compute @workgroup_size(1)
fn main() {
    var count = 0u;
    // Not foldable: the compiler cannot know where the count stands.
    let end = counted[1];
    for (var k = 0u; k < end; k++) {
        count += 1u + (count & counted[2]);
    }
    counted[0] = count;
}
