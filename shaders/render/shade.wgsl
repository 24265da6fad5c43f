// Shading of facets and obstacles: the mean of a pixel's samples.
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(3) var<storage, read_write> front: array<u32>;
@group(3) @binding(13) var<storage, read> holder: array<u32>;
@group(3) @binding(15) var<storage, read_write> scenery: array<u32>; // red, green, blue, and how much of the pixel they cover

const STONE: vec3f = vec3f(0.58, 0.60, 0.64);
const FLOOR: vec3f = vec3f(0.20, 0.21, 0.25);
// How much lighter the lines of a floor are, and half their width as a part of a square.
const LINES: f32 = 0.09;
const LINE: f32 = 0.012;

struct Sample { color: vec3f, cover: f32, depth: f32 }

fn tint(f: Facet, w: vec4f) -> vec3f {
    let all = mat3x3f(unpack4x8unorm(color[f.ids.x]).rgb, unpack4x8unorm(color[f.ids.y]).rgb, unpack4x8unorm(color[f.ids.z]).rgb);
    return all * w.xyz;
}

fn facet_color(f: Facet, w: vec4f, p: vec3f, view: vec3f, jitter: vec2f) -> vec3f {
    let sum = w.x * vertex[2u * f.ids.x + 1u] + w.y * vertex[2u * f.ids.y + 1u] + w.z * vertex[2u * f.ids.z + 1u];
    let mean = sum.xyz / max(length(sum), 1e-30);
    if f.line { return strand(tint(f, w), mean, view, sees_lamp(p, LAMP, jitter)); }
    // Corners that go round against the clock are seen from the front; right and down is left-handed.
    let facing = -sign(turn(f.b.xy - f.a.xy, f.c.xy - f.a.xy));
    let normal = facing * mean;
    let dyed = select(tint(f, w), 0.55 * tint(f, w) + 0.06, facing < 0.0);
    return matte(dyed, normal, view, sees_lamp(p, normal, jitter));
}

fn solid_color(m: Meeting, p: vec3f, view: vec3f, jitter: vec2f) -> vec4f {
    let s = solid[m.number];
    let light = sees_lamp(p, m.normal, jitter);
    if s.shape != PLANE { return vec4f(matte(STONE, m.normal, view, light), 1.0); }
    let square = abs(fract(unturned(s.turn, p - s.place).xy / s.size.x + 0.5) - 0.5);
    let line = select(0.0, LINES, min(square.x, square.y) < LINE);
    // Far away it is lost in the dark.
    return vec4f(matte(FLOOR + line, m.normal, view, light), clamp(1.6 - 0.6 * length(p) / frame.lamp, 0.0, 1.0));
}

fn sample_at(place: vec2f, id: u32, jitter: vec2f) -> Sample {
    let half = 0.5 * vec2f(f32(frame.width), f32(frame.height));
    let off = (place - half) * vec2f(1.0, -1.0) / frame.scale;
    let eye = frame.distance > 0.0;
    let o = select(vec3f(off, 0.0), vec3f(0.0, 0.0, frame.distance), eye);
    let d = select(vec3f(0.0, 0.0, -1.0), vec3f(off / frame.distance, -1.0), eye);
    let m = meet(o, d, select(-NEVER, NEAR * frame.distance, eye), true);
    if id != NONE {
        let f = facet_of(id);
        let w = parts(f, place);
        let depth = depth_of(f, w);
        if depth < m.way { return Sample(facet_color(f, w, o + depth * d, -normalize(d), jitter), 1.0, depth); }
    }
    if m.way >= NEVER { return Sample(vec3f(), 0.0, m.way); }
    let c = solid_color(m, o + m.way * d, -normalize(d), jitter);
    return Sample(c.rgb, c.a, m.way);
}

@compute @workgroup_size(WORKGROUP)
fn shade(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let corner = vec2u(i % frame.width, i / frame.width) * frame.fine;
        var sum = vec4f();
        var depth = NEVER;
        for (var y = corner.y; y < corner.y + frame.fine; y += 1u) {
            for (var x = corner.x; x < corner.x + frame.fine; x += 1u) {
                let id = holder[y * frame.width * frame.fine + x];
                if id == NONE && frame.solids == 0u { continue; }
                let place = vec2f(f32(x) + 0.5, f32(y) + 0.5) / f32(frame.fine);
                let one = sample_at(place, id, fract(place) - 0.5);
                sum += one.cover * vec4f(one.color, 1.0);
                depth = min(depth, one.depth);
            }
        }
        let samples = frame.fine * frame.fine;
        scenery[i] = pack4x8unorm(vec4f(sum.rgb / max(sum.a, 1e-30), sum.a / f32(samples)));
        // What covers half of a pixel hides what is behind it.
        if sum.a >= 0.5 * f32(samples) { front[i] = key(depth); }
    }
}
