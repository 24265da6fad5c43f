// Elements are rows: those behind the ones in use hold nothing.
@group(0) @binding(0) var<uniform> world: World;

fn end_of(block: u32) -> u32 { return min(min(block + extent.block, extent.elements), world.count); }
