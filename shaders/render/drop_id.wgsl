// The particle of the drop in each pixel: of all that are as near as the nearest the one with the lowest id.
@group(3) @binding(16) var<storage, read> crest: array<u32>;
@group(3) @binding(19) var<storage, read_write> source: array<atomic<u32>>;

// Depths that so few of the numbers between them part are one: the last places may differ from those of another shader.
const SAME: u32 = 64u;

fn mark(i: u32, p: vec4f, x: i32, y: i32) {
    let at = pixel(x, y);
    let depth = key(depth_at(p, bulge(p, x, y)));
    // Beyond the last key there is none: a particle that is nowhere nearest has no pixel.
    if depth <= crest[at] + SAME { atomicMin(&source[at], i); }
}
