// The grids of the coarse pressure: where the cells of each stand in arrays of all. See `src/step/coarse.rs`.

fn place_of(level: u32, cell: u32) -> u32 {
    let columns = LEVEL_COLUMNS[level];
    return LEVEL_FIRST[level] + cell / columns * (columns + 2u) + cell % columns;
}

fn cells_of(level: u32) -> u32 {
    return LEVEL_COLUMNS[level] * LEVEL_ROWS[level];
}

// The place of one of the four cells that make up a coarse one, seen from the finer grid; 0, which holds zeros, where there is none.
fn child_of(level: u32, cell: u32, child: u32) -> u32 {
    let columns = LEVEL_COLUMNS[level + 1u];
    let x = 2u * (cell % columns) + child % 2u;
    let y = 2u * (cell / columns) + child / 2u;
    let inside = x < LEVEL_COLUMNS[level] && y < LEVEL_ROWS[level];
    return select(0u, LEVEL_FIRST[level] + y * (LEVEL_COLUMNS[level] + 2u) + x, inside);
}

// The place of the coarse cell that a cell belongs to, `x` and `y` one more than its column and row: those around the grid have one too.
fn parent_of(level: u32, x: u32, y: u32) -> u32 {
    return LEVEL_FIRST[level + 1u] + ((y + 1u) / 2u - 1u) * (LEVEL_COLUMNS[level + 1u] + 2u) + ((x + 1u) / 2u - 1u);
}
