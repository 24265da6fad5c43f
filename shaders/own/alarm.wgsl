// The alarm, for visits that do not declare it.
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>;
