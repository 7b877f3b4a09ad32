// Counting sort of the points into cells, 4 of 7: the running sum over the tiles, exclusive, by one workgroup; each
// invocation takes a run of tiles.

var<workgroup> runs: array<u32, REDUCERS>;

@compute @workgroup_size(REDUCERS)
fn main(@builtin(local_invocation_index) local: u32) {
    let length = (TILES + REDUCERS - 1u) / REDUCERS;
    let first = min(local * length, TILES);
    let last = min(first + length, TILES);
    var sum = 0u;
    for (var tile = first; tile < last; tile++) {
        sum += tile_sums[tile];
    }
    runs[local] = sum;
    workgroupBarrier();
    var before = 0u;
    for (var k = 0u; k < local; k++) {
        before += runs[k];
    }
    for (var tile = first; tile < last; tile++) {
        let own = tile_sums[tile];
        tile_sums[tile] = before;
        before += own;
    }
}
