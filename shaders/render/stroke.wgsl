// Strokes of light on the canvas, from x − v·tail to x:  w = (1 − s) q² (¼ + ¾ q⁴),  q = 1 − d²/R²,  R = (1 − ⅗ s) glow, in whole parts of `unit`.
// s is 0 at the particle and 1 at the far end, d the distance from the line: at rest it is the light that `splat` draws.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // in w: −2 of particles that are not drawn, −1 of those out of the picture
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(2) var<storage, read_write> canvas: array<atomic<u32>>; // red, green, blue
@group(3) @binding(3) var<storage, read> front: array<u32>;

// Pixels along a stroke that one layer of the dispatch walks, so that no invocation loops too long.
override WALK: i32 = 64;

const WORKGROUP: u32 = 64u;
// The relative narrowing at its far end.
const TAPER: f32 = 0.6;

fn draw(light: vec3f, layer: i32, head: Seen, end: Seen) {
    let way = end.place - head.place;
    // Along the longer side of the stroke, pixel by pixel; across it, the few pixels that it can touch.
    let steep = abs(way.y) > abs(way.x);
    let start = select(head.place, head.place.yx, steep);
    let along = select(way, way.yx, steep);
    let size = select(vec2f(f32(frame.width), f32(frame.height)), vec2f(f32(frame.height), f32(frame.width)), steep);
    let low = i32(clamp(floor(min(start.x, start.x + along.x) - frame.glow), 0.0, size.x));
    let high = i32(clamp(ceil(max(start.x, start.x + along.x) + frame.glow), 0.0, size.x));
    // On a diagonal √2 more than straight across.
    let across = 1.4143 * frame.glow;
    let squared = max(dot(way, way), 1e-12);
    for (var u = low + layer * WALK; u < min(high, low + layer * WALK + WALK); u += 1) {
        var part = 0.0;
        if along.x != 0.0 {
            part = clamp((f32(u) + 0.5 - start.x) / along.x, 0.0, 1.0);
        }
        // Of the pixel whose middle is there.
        let row = start.y + part * along.y - 0.5;
        let first = i32(clamp(floor(row - across), 0.0, size.y));
        let last = i32(clamp(ceil(row + across), 0.0, size.y));
        for (var v = first; v < last; v += 1) {
            let x = select(u, v, steep);
            let y = select(v, u, steep);
            let off = middle(x, y) - head.place;
            let s = clamp(dot(off, way) / squared, 0.0, 1.0);
            let d = (off - s * way) / (frame.glow * (1.0 - TAPER * s));
            let q = 1.0 - dot(d, d);
            let at = pixel(x, y);
            if q > 0.0 && key(mix(head.depth, end.depth, s)) < front[at] {
                let add = vec3u(light * ((1.0 - s) * q * q * (0.25 + 0.75 * q * q * q * q)) + 0.5);
                atomicAdd(&canvas[3u * at], add.r);
                atomicAdd(&canvas[3u * at + 1u], add.g);
                atomicAdd(&canvas[3u * at + 2u], add.b);
            }
        }
    }
}

@compute @workgroup_size(WORKGROUP)
fn strokes(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let v = velocity[i];
        if !broken(x) && !broken(v) && projected[i].w > -1.5 {
            let head = see(x.xyz);
            var end = see(x.xyz - frame.tail * v.xyz);
            // What began behind the eye, or further away than there are pixels, is a light.
            if !end.visible { end = head; }
            if head.visible { draw(frame.unit * unpack4x8unorm(color[i]).rgb, i32(group.z), head, end); }
        }
    }
}
