// Where rays intersect solids: a ball or capsule (a segment along its own z, and all within a radius of it), a box by its slabs
// (Kay and Kajiya 1986), a plane across its own z, seen from above, or
// the surface of a cone about its own z, seen from within alone, so that it is cut open towards the eye. In the picture's axes.
struct Solid {
    place: vec3f, radius: f32,
    size: vec3f,  shape: u32, // half of a box's sides; half of a segment or a cone in z; of a plane the squares of its grid, of a cone its upper radius in x
    turn: vec4f,              // from its own axes, as a quaternion
}
@group(1) @binding(12) var<storage, read> solid: array<Solid>;

struct Meeting { way: f32, normal: vec3f, number: u32 }

const ROUND: u32 = 0u;
const BOX: u32 = 1u;
const PLANE: u32 = 2u;
const CONE: u32 = 3u;
const NEVER: f32 = 1e30;

fn turned(q: vec4f, v: vec3f) -> vec3f { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
fn unturned(q: vec4f, v: vec3f) -> vec3f { return turned(vec4f(-q.xyz, q.w), v); }

// Along a ray of any length to a ball about the origin; NEVER when it passes. By the nearest approach, which rounds little.
fn to_ball(o: vec3f, d: vec3f, radius: f32) -> f32 {
    let along = -dot(o, d) / dot(d, d);
    let off = o + along * d;
    let rest = radius * radius - dot(off, off);
    if rest < 0.0 { return NEVER; }
    return along - sqrt(rest / dot(d, d));
}

fn meet_round(o: vec3f, d: vec3f, s: Solid) -> vec4f {
    let flat = max(dot(d.xy, d.xy), 1e-9);
    let along = -dot(o.xy, d.xy) / flat;
    let off = o.xy + along * d.xy;
    let tube = along - sqrt(max(s.radius * s.radius - dot(off, off), 0.0) / flat);
    let core = vec3f(0.0, 0.0, clamp(o.z + tube * d.z, -s.size.z, s.size.z));
    var way = to_ball(o - core, d, s.radius);
    // Between the ends the ray intersects the tube; beyond them a ball.
    if abs(o.z + tube * d.z) < s.size.z { way = select(tube, NEVER, dot(off, off) > s.radius * s.radius); }
    return vec4f((o + way * d - core) / s.radius, way);
}

fn meet_box(o: vec3f, d: vec3f, s: Solid) -> vec4f {
    let safe = select(d, vec3f(1e-9), abs(d) < vec3f(1e-9));
    let middle = -o / safe;
    let half = abs(s.size / safe);
    let enter = middle - half;
    let leave = middle + half;
    let way = max(enter.x, max(enter.y, enter.z));
    let first = select(vec3f(0.0), vec3f(1.0), enter >= vec3f(way));
    return vec4f(-sign(d) * first, select(way, NEVER, way > min(leave.x, min(leave.y, leave.z))));
}

// Where the ray leaves the cone: the root at which the square of the distance from the axis overtakes that of the radius.
fn meet_cone(o: vec3f, d: vec3f, s: Solid) -> vec4f {
    let slope = 0.5 * (s.size.x - s.radius) / s.size.z;
    let wide = 0.5 * (s.size.x + s.radius) + slope * o.z;
    let a = dot(d.xy, d.xy) - slope * slope * d.z * d.z;
    let b = dot(o.xy, d.xy) - slope * d.z * wide;
    let c = dot(o.xy, o.xy) - wide * wide;
    let rest = b * b - a * c;
    let root = sqrt(max(rest, 0.0));
    // Of two forms that which does not cancel.
    var way = -c / max(b + root, 1e-30);
    if b < 0.0 { way = (root - b) / select(a, 1e-9, abs(a) < 1e-9); }
    let p = o + way * d;
    let radius = wide + slope * way * d.z;
    let hit = rest >= 0.0 && abs(p.z) <= s.size.z && radius > 0.0;
    return vec4f(normalize(vec3f(-p.xy, slope * radius)), select(NEVER, way, hit));
}

// The nearest of all that is further along than `least`. What is cut open has no shadow.
fn meet(o: vec3f, d: vec3f, least: f32, open: bool) -> Meeting {
    var best = Meeting(NEVER, vec3f(), NONE);
    for (var k = 0u; k < frame.solids; k += 1u) {
        let s = solid[k];
        let own = unturned(s.turn, o - s.place);
        let way = unturned(s.turn, d);
        var m = vec4f(0.0, 0.0, 1.0, -own.z / way.z);
        if s.shape == ROUND { m = meet_round(own, way, s); }
        if s.shape == BOX { m = meet_box(own, way, s); }
        if s.shape == CONE { m = meet_cone(own, way, s); }
        let front = (s.shape != PLANE || way.z < 0.0) && (s.shape != CONE || open);
        if front && m.w > least && m.w < best.way { best = Meeting(m.w, turned(s.turn, m.xyz), k); }
    }
    return best;
}
