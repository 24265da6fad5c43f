// A fluid as balls (van der Laan, Green and Sainz 2009): of each pixel the nearest front, how much fluid there is along the
// line of sight, in whole parts, and how much of the pixel is covered.
@group(3) @binding(3) var<storage, read> front: array<u32>;
@group(3) @binding(16) var<storage, read_write> crest: array<atomic<u32>>;
@group(3) @binding(17) var<storage, read_write> volume: array<atomic<u32>>;
@group(3) @binding(18) var<storage, read_write> rim: array<atomic<u32>>;

fn mark(i: u32, p: vec4f, x: i32, y: i32) {
    let at = pixel(x, y);
    let half = bulge(p, x, y);
    let depth = key(depth_at(p, half));
    // Of what a solid hides it is known that it is there.
    atomicMax(&rim[at], u32(255.0 * clamp(p.w + 0.5 - distance(middle(x, y), p.xy), 0.0, 1.0) + 0.5));
    if depth < front[at] {
        atomicMin(&crest[at], depth);
        atomicAdd(&volume[at], u32(frame.grain * half + 0.5));
    }
}
