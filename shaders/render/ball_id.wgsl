// The particle of the nearest ball in each pixel; of several at the same depth the one with the lowest id.
@group(3) @binding(3) var<storage, read> front: array<u32>;
@group(3) @binding(4) var<storage, read_write> owner: array<atomic<u32>>;

fn mark(i: u32, p: vec4f, x: i32, y: i32) {
    if front[pixel(x, y)] == key(p.z) { atomicMin(&owner[pixel(x, y)], i); }
}
