// Light on a fluid: what is behind it is bent and absorbed,  T = exp(−t (k − stain dye) / clarity)  (Beer 1852), the rest is the colour of the dye;
// the sky is reflected by Schlick's fraction (1994), the lamp as a highlight (Blinn 1977). Foam is matte.
@group(3) @binding(3) var<storage, read> front: array<u32>;
@group(3) @binding(15) var<storage, read> scenery: array<u32>;
@group(3) @binding(20) var<storage, read> level: array<f32>;
@group(3) @binding(21) var<storage, read> thickness: array<f32>;
@group(3) @binding(22) var<storage, read> dye: array<u32>;
@group(3) @binding(28) var<storage, read> cover: array<f32>;
@group(3) @binding(26) var<storage, read_write> wet: array<u32>;

const WORKGROUP: u32 = 64u;
const NEVER: f32 = 1e30;
const LAMP: vec3f = vec3f(-0.48, 0.6, 0.64); // right, up, towards the eye; of length 1
const ABSORB: f32 = 1.1;
const BEND: f32 = 0.35;      // pixels aside, for each of the thickness and of the normal's
const FURTHEST: f32 = 40.0;  // of those
const LOW: vec3f = vec3f(0.32, 0.36, 0.44);
const HIGH: vec3f = vec3f(0.80, 0.90, 1.0);
const GLASS: vec3f = vec3f(0.42, 0.48, 0.56);
const BEHIND: f32 = 0.5;
const BEFORE: f32 = 0.8;
const WALL: vec3f = vec3f(0.50, 0.52, 0.56);
// A fluid ends where its drops cover so much of what is near, in space one alone earlier than many. From its outline it bends so far inwards, as
// a part of how wide that is made smooth.
const EDGE: f32 = 0.4;
const ALONE: f32 = 0.6;
const MANY: f32 = 0.35;
const FEWEST: f32 = 0.22;
const BEND_IN: f32 = 1.2;

// A point of the surface, in the picture's axes.
fn place_of(x: i32, y: i32, z: f32) -> vec3f {
    let half = 0.5 * vec2f(f32(frame.width), f32(frame.height));
    let off = (middle(x, y) - half) / vec2f(frame.scale, -frame.scale);
    if frame.distance > 0.0 { return vec3f(off * z / frame.distance, -z); }
    return vec3f(off, -z);
}

fn level_at(x: i32, y: i32) -> f32 {
    // What is below 0 is much.
    if u32(x) >= frame.width || u32(y) >= frame.height { return NEVER; }
    return level[pixel(x, y)];
}

// Half the way from one neighbour to the other; from one to the next where the other is beyond a step, and nothing where there is
// none.
fn slope(x: i32, y: i32, z: f32, way: vec2i) -> vec3f {
    let here = place_of(x, y, z);
    let a = level_at(x - way.x, y - way.y);
    let b = level_at(x + way.x, y + way.y);
    if min(a, b) >= NEVER { return place_of(x + way.x, y + way.y, z) - here; }
    if max(abs(a - z), abs(b - z)) < frame.range * frame.drop {
        return 0.5 * (place_of(x + way.x, y + way.y, b) - place_of(x - way.x, y - way.y, a));
    }
    if abs(a - z) < abs(b - z) { return here - place_of(x - way.x, y - way.y, a); }
    return place_of(x + way.x, y + way.y, b) - here;
}

// The colour behind the fluid, at a pixel.
fn under(place: vec2f, depth: f32) -> vec3f {
    let size = vec2f(f32(frame.width), f32(frame.height));
    let q = min(max(place, vec2f()), size - 0.5);
    let i = pixel(i32(q.x), i32(q.y));
    let stands = unpack4x8unorm(scenery[i]);
    let lines = edges(q, depth, front[i]).x;
    return mix(mix(background(q), stands.rgb, stands.a), GLASS, BEHIND * lines);
}

// To the right and down: the picture's y is up.
fn normal_at(x: i32, y: i32, z: f32) -> vec3f {
    return normalize(cross(slope(x, y, z, vec2i(0, 1)), slope(x, y, z, vec2i(1, 0))));
}

// How far inside the outlines of fluid and of walls a pixel is, and how far inside that from which normals turn, in about pixels.
// Both end where neither covers much, and where the other covers more. Of many drops in space normals turn by the smoother outline.
fn depths_at(x: i32, y: i32) -> vec3f {
    let i = 3u * pixel(clamp(x, 0, i32(frame.width) - 1), clamp(y, 0, i32(frame.height) - 1));
    if cover[i + 2u] <= 0.0 { return vec3f(-1.0); }
    let parts = vec2f(cover[i], cover[i + 1u]) / cover[i + 2u];
    let soft = f32(frame.soft);
    if frame.turn > 0.0 {
        let alone = (parts.x - ALONE) * soft;
        let many = (parts.y - MANY) * f32(frame.softer);
        return vec3f(max(alone, many), -1.0, mix(alone, many, smoothstep(FEWEST, MANY, parts.y)));
    }
    return soft * vec3f(min(vec2f(parts.x + parts.y - EDGE), vec2f(parts.x - parts.y, parts.y - parts.x)), 0.0);
}

// Its change from pixel to pixel, to the right and up.
struct Outline { depth: vec3f, right: vec3f, up: vec3f }

fn outline_at(x: i32, y: i32) -> Outline {
    let right = 0.5 * (depths_at(x + 1, y) - depths_at(x - 1, y));
    let up = 0.5 * (depths_at(x, y - 1) - depths_at(x, y + 1));
    return Outline(depths_at(x, y), right, up);
}

// The part of a pixel within an outline that is so many pixels farther out, less a half, by the distance from it.
fn part_within(depth: f32, change: vec2f, more: f32) -> f32 {
    let steep = max(length(change), 0.1);
    return clamp(more + depth / steep, 0.0, 1.0);
}

// Near its outline a surface turns away from the eye, as that of a ball does.
fn turned(normal: vec3f, outline: Outline) -> vec3f {
    let change = vec2f(outline.right.z, outline.up.z);
    let near = 1.0 - clamp(outline.depth.z / (BEND_IN * f32(frame.soft)), 0.0, 1.0);
    let part = frame.turn * near * near * min(length(change), 1.0);
    return normalize(mix(normal, vec3f(-change / max(length(change), 1e-9), 0.0), part));
}

fn shaded(i: u32, here: vec3f, normal: vec3f, behind: vec3f) -> vec3f {
    let view = select(vec3f(0.0, 0.0, 1.0), -normalize(here), frame.distance > 0.0);
    let paint = unpack4x8unorm(dye[i]);
    let clear = exp(-thickness[i] * frame.absorption * (ABSORB - frame.stain * paint.rgb));
    let day = max(0.6 * dot(normal, LAMP) + 0.4, 0.0);
    let facing = clamp(dot(normal, view), 0.0, 1.0);
    let mirror = (0.03 + 0.97 * pow(1.0 - facing, 5.0)) * (1.0 - paint.a);
    let sky = frame.gloss * mix(LOW, HIGH, 0.5 + 0.5 * reflect(-view, normal).y);
    let shine = pow(max(dot(normal, normalize(LAMP + view)), 0.0), 120.0) * (1.0 - paint.a);
    var c = mix(paint.rgb * (0.4 + 0.75 * day), behind, clear);
    // Mist where it is thin.
    c = mix(c, vec3f(0.7 + 0.3 * day), paint.a * (1.0 - pow(clear.r, 4.0)));
    return clamp(mix(c, sky, mirror) + 0.8 * shine, vec3f(0.0), vec3f(1.0));
}

@compute @workgroup_size(WORKGROUP)
fn water(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let x = i32(i % frame.width);
        let y = i32(i / frame.width);
        let z = level[i];
        let outline = outline_at(x, y);
        let box = within(middle(x, y));
        var normal = vec3f();
        var bend = vec2f();
        if z < NEVER {
            normal = turned(normal_at(x, y, z), outline);
            var scale = frame.scale;
            if frame.distance > 0.0 { scale *= frame.distance / z; }
            bend = min(BEND * scale * thickness[i], FURTHEST) * vec2f(normal.x, -normal.y);
        }
        var c = under(middle(x, y) + bend, z);
        // Under the edge of the fluid a wall goes on.
        let wall = part_within(outline.depth.y, vec2f(outline.right.y, outline.up.y), 1.5);
        if front[i] == NONE { c = mix(c, WALL, box * wall); }
        if z < NEVER {
            let part = part_within(outline.depth.x, vec2f(outline.right.x, outline.up.x), 0.5);
            c = mix(c, shaded(i, place_of(x, y, z), normal, c), box * part);
        }
        c = mix(c, GLASS, BEFORE * edges(middle(x, y), z, front[i]).y);
        wet[i] = pack4x8unorm(vec4f(c, 1.0));
    }
}
