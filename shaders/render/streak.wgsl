// Trails: lines from where each particle was to where it is, brighter towards the present; the brightest wins a pixel.
// Coverage by distance from the line (Gupta and Sproull 1981), here with a linear edge.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;
@group(1) @binding(4) var<storage, read> trail: array<vec4f>; // all particles at the first time, at the second, …
@group(3) @binding(3) var<storage, read> front: array<u32>;
@group(3) @binding(5) var<storage, read_write> streak: array<atomic<u32>>; // brightness in the upper half, id in the lower

const WORKGROUP: u32 = 64u;
// Pixels along a line that one layer of the dispatch walks, so that no invocation loops too long.
const WALK: u32 = 1024u;
const OLDEST: f32 = 0.25;
const NEWEST: f32 = 0.95;

fn draw(i: u32, layer: u32, a: Seen, b: Seen, age: f32) {
    let way = b.place - a.place;
    // Along the longer side of the line, pixel by pixel; across it, the few pixels that the line can touch.
    let steep = abs(way.y) > abs(way.x);
    let start = select(a.place, a.place.yx, steep);
    let along = select(way, way.yx, steep);
    let size = select(vec2f(f32(frame.width), f32(frame.height)), vec2f(f32(frame.height), f32(frame.width)), steep);
    let low = i32(clamp(floor(min(start.x, start.x + along.x) - frame.line - 0.5), 0.0, size.x));
    let high = i32(clamp(ceil(max(start.x, start.x + along.x) + frame.line + 0.5), 0.0, size.x));
    // On a diagonal √2 more than straight across.
    let across = i32(ceil(1.4143 * (frame.line + 0.5) + 0.5)) - 1;
    let squared = max(dot(way, way), 1e-12);
    let first_step = max(low, i32(layer * WALK));
    for (var u = first_step; u < min(high, i32((layer + 1u) * WALK)); u += 1) {
        var part = 0.0;
        if along.x != 0.0 {
            part = clamp((f32(u) + 0.5 - start.x) / along.x, 0.0, 1.0);
        }
        let first = i32(floor(start.y + part * along.y)) - across;
        let end = first + 2 * across + 1;
        for (var v = max(first, 0); v < min(end, i32(size.y)); v += 1) {
            let x = select(u, v, steep);
            let y = select(v, u, steep);
            let off = middle(x, y) - a.place;
            let t = clamp(dot(off, way) / squared, 0.0, 1.0);
            let bright = mix(OLDEST, NEWEST, age) * clamp(frame.line + 0.5 - length(off - t * way), 0.0, 1.0);
            if bright > 0.0 && key(mix(a.depth, b.depth, t)) < front[pixel(x, y)] {
                atomicMax(&streak[pixel(x, y)], (u32(bright * 65535.0) << 16u) | i);
            }
        }
    }
}

@compute @workgroup_size(WORKGROUP)
fn streaks(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let s = folded(group, groups) * WORKGROUP + lane;
    if s < frame.points {
        let i = s % world.capacity;
        let past = trail[s];
        var next = position[i];
        if s + world.capacity < frame.points { next = trail[s + world.capacity]; }
        if !broken(past) && !broken(next) {
            let a = see(past.xyz);
            let b = see(next.xyz);
            let age = f32(s / world.capacity + 1u) / f32(frame.points / world.capacity);
            if a.visible && b.visible { draw(i, group.z, a, b, age); }
        }
    }
}
