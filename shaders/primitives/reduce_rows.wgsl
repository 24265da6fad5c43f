// Elements are rows: those after the rows in use take no part.
@group(0) @binding(0) var<uniform> world: World;

fn end_of(block: u32) -> u32 { return min(block + extent.block, world.count); }
