// Displacements since the list was built. Two particles that have each moved by less than half of the skin are no more than
// the skin closer to each other, so a pair that is in range now was within range + skin then, and is listed (Verlet 1967).
@group(2) @binding(12) var<storage, read> list_origin: array<vec4f>; // xyz: where it was then; w: 1 if it was active, or the side of the box

// Half of the skin, less what rounding may add to distances.
override LIMIT: f32 = 0.0;
// In a periodic box positions are rounded where they are wrapped: sixteen units of their last place.
const ROUNDING: f32 = 9.5367431640625e-7; // 2⁻²⁰
const WORKGROUP: u32 = 64u;
// Whether the box changes. Its distances change with it: of a pair beyond the reach then, those to particles that move with the box.
override ELASTIC: bool = false;
override REACH: f32 = 1.0;

fn has_moved(i: u32) -> bool {
    let origin = list_origin[i];
    let x = position[i].xyz;
    let present = is_active(i);
    if present != (origin.w > 0.0) { return true; }
    var limit = LIMIT;
    var start = origin.xyz;
    if ELASTIC && present {
        let part = world.period.x / origin.w;
        start = select(start, world.low + part * (start - world.low), world.period > vec3f());
        limit += 0.5 * (part - 1.0) * REACH;
        if limit <= 0.0 { return true; }
    }
    if PERIODIC {
        let size = max(abs(x), abs(start));
        limit -= ROUNDING * max(size.x, max(size.y, size.z));
    }
    limit = max(limit, 0.0);
    let way = shortest(x - start);
    let square = way.x * way.x + way.y * way.y + way.z * way.z;
    return present && !(all(x == start) || square < limit * limit);
}

@compute @workgroup_size(WORKGROUP)
fn moved(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && has_moved(i) { atomicStore(&list_state[0].moved, 1u); }
}
