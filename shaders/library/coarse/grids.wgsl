// The grids of the coarse pressure: where the cells of each stand in arrays of all. See `src/step/coarse.rs`.

struct Level {
    first: u32,
    columns: u32,
    rows: u32,
}

fn place_of(grid: Level, cell: u32) -> u32 {
    return grid.first + cell / grid.columns * (grid.columns + 2u) + cell % grid.columns;
}

fn cells_of(grid: Level) -> u32 {
    return grid.columns * grid.rows;
}

// The place of one of the four cells that make up a coarse one; 0, which holds zeros, where there is none.
fn child_of(fine: Level, coarse: Level, cell: u32, child: u32) -> u32 {
    let x = 2u * (cell % coarse.columns) + child % 2u;
    let y = 2u * (cell / coarse.columns) + child / 2u;
    let inside = x < fine.columns && y < fine.rows;
    return select(0u, fine.first + y * (fine.columns + 2u) + x, inside);
}

// The place of the coarse cell that a cell belongs to, `x` and `y` one more than its column and row: those around a grid have one too.
fn parent_in(coarse: Level, x: u32, y: u32) -> u32 {
    return coarse.first + ((y + 1u) / 2u - 1u) * (coarse.columns + 2u) + ((x + 1u) / 2u - 1u);
}
