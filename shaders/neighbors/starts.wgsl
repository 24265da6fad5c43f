// The first slot of each cell in the cell list; after the last cell, the number of all particles.
@group(2) @binding(1) var<storage, read> starts: array<u32>;
