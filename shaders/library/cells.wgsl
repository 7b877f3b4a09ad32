// The cell of a place; one outside the rectangle counts to the nearest cell.

fn cell_of(place: vector) -> vec2<u32> {
    let along = clamp(place * CELLS_PER_METRE, vector(0.0, 0.0), vector(real(CELLS_X), real(CELLS_Y)));
    return min(vec2<u32>(along), vec2<u32>(CELLS_X - 1u, CELLS_Y - 1u));
}

fn cell_index(cell: vec2<u32>) -> u32 {
    return cell.y * CELLS_X + cell.x;
}
