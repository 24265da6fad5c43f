// Walls in the plane of a fluid: of each pixel how much of it particles of a wall cover.
@group(3) @binding(27) var<storage, read_write> wall: array<atomic<u32>>;

fn mark(i: u32, p: vec4f, x: i32, y: i32) {
    atomicMax(&wall[pixel(x, y)], u32(255.0 * clamp(p.w + 0.5 - distance(middle(x, y), p.xy), 0.0, 1.0) + 0.5));
}
