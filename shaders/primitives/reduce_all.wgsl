// All elements take part.
fn end_of(block: u32) -> u32 { return min(block + extent.block, extent.elements); }
