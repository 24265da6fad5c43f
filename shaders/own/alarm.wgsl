// The alarm, where a visit has none of its own.
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>;
