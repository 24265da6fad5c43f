// Where the particles of each cell begin in the cell list; behind the last cell, how many are in it.
@group(2) @binding(1) var<storage, read> starts: array<u32>;
