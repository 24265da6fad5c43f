// Light on cloth and solids (Lambert 1760 beyond the terminator, Blinn 1977), on threads along their direction (Kajiya and Kay
// 1989), and shadows: of facets by a map of what the lamp sees (Williams 1978), of solids by rays to a lamp of some size.
@group(3) @binding(14) var<storage, read> lit: array<u32>; // the nearest to the lamp

const LAMP: vec3f = vec3f(-0.48, 0.6, 0.64); // right, up, towards the eye; of length 1, as are the other two
const LAMP_RIGHT: vec3f = vec3f(0.8, 0.0, 0.6);
const LAMP_UP: vec3f = vec3f(0.36, 0.8, -0.48);
// A surface that is so near casts no shadow [pixels of the map].
const BIAS: f32 = 2.5;
// The shadow's edge [pixels of the map]; and the lamp's own width, as seen from here.
const RIM: f32 = 4.0;
const WIDTH: f32 = 0.09;

// The part of the lamp that `jitter` stands for, from −½ to ½ each way: 1 when it is seen, 0 when not.
fn sees_lamp(p: vec3f, normal: vec3f, jitter: vec2f) -> f32 {
    let texel = 2.0 * frame.lamp / f32(frame.map);
    let q = p + BIAS * texel * normal;
    let at = 0.5 * f32(frame.map) + vec2f(dot(q, LAMP_RIGHT), -dot(q, LAMP_UP)) / texel + RIM * jitter;
    let inside = all(at >= vec2f(0.0)) && all(at < vec2f(f32(frame.map)));
    if inside && lit[u32(at.y) * frame.map + u32(at.x)] < key(-dot(q, LAMP) - BIAS * texel) { return 0.0; }
    let way = LAMP + WIDTH * (jitter.x * LAMP_RIGHT + jitter.y * LAMP_UP);
    return select(0.0, 1.0, meet(q, way, 0.0, false).way >= NEVER);
}

// `view` leads to the eye.
fn matte(color: vec3f, normal: vec3f, view: vec3f, light: f32) -> vec3f {
    let day = max(0.8 * dot(normal, LAMP) + 0.2, 0.0) * light;
    let shine = pow(max(dot(normal, normalize(LAMP + view)), 0.0), 20.0) * light;
    let facing = clamp(dot(normal, view), 0.0, 1.0);
    let rim = pow(1.0 - facing, 4.0);
    return color * (0.22 + 0.08 * normal.y + 0.72 * day) + 0.1 * shine + 0.08 * rim;
}

fn strand(color: vec3f, along: vec3f, view: vec3f, light: f32) -> vec3f {
    let l = dot(along, LAMP);
    let v = dot(along, view);
    let day = sqrt(max(1.0 - l * l, 0.0));
    let shine = pow(max(day * sqrt(max(1.0 - v * v, 0.0)) - l * v, 0.0), 30.0);
    return color * (0.25 + (0.2 + 0.45 * light) * day) + (0.1 + 0.35 * light) * shine * (0.3 + 0.7 * color);
}
