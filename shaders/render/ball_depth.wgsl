// The nearest ball in each pixel:  front = min depth (the z-buffer, Catmull 1974)
@group(3) @binding(3) var<storage, read_write> front: array<atomic<u32>>;

fn mark(i: u32, p: vec4f, x: i32, y: i32) { atomicMin(&front[pixel(x, y)], key(p.z)); }
