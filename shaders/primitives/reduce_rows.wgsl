// Elements are rows: those behind the ones in use, of which there are no more than elements, hold nothing.
@group(0) @binding(0) var<uniform> world: World;

fn end_of(block: u32) -> u32 { return min(block + extent.block, world.count); }
