// The nearest facet at each sample:  nearest = min depth (the z-buffer, Catmull 1974)
@group(3) @binding(12) var<storage, read_write> nearest: array<atomic<u32>>;

fn mark(i: u32, at: u32, depth: u32) { atomicMin(&nearest[at], depth); }
