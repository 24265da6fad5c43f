// Each particle and its neighbours on the list, in the order of their ids, as far as they are in range.
@group(2) @binding(8) var<storage, read> list: array<vec4u>;

override RANGE: f32 = 1.0;
// The first row of this dispatch.
override FIRST_ROW: u32 = 0u;
const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;

fn consider(k: u32, id: u32, n: u32, end: u32, me: Particle, sum: ptr<function, Sum>) {
    let you = neighbor(id, pair_at(k, n));
    let r = shortest(you.position - me.position);
    if REMEMBERS && n < end { forget(you.pair); }
    let near = r.x * r.x + r.y * r.y + r.z * r.z < RANGE * RANGE;
    if n < end && near { gather(me, you, r, sum); }
    if REMEMBERS && n < end { store_history(you.pair); }
}

@compute @workgroup_size(WORKGROUP)
fn listed(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = FIRST_ROW + folded(group, groups) * WORKGROUP + lane;
    if k < world.count {
        let head = list[k];
        let me = neighbor(head.y, NONE);
        if head.y != NONE && acts_on(me) {
            var sum = Sum();
            for (var n = 0u; n < head.x; n += 4u) {
                let ids = list[(1u + n / 4u) * world.capacity + k];
                consider(k, ids.x, n, head.x, me, &sum);
                consider(k, ids.y, n + 1u, head.x, me, &sum);
                consider(k, ids.z, n + 2u, head.x, me, &sum);
                consider(k, ids.w, n + 3u, head.x, me, &sum);
            }
            deliver(k, me, sum);
        } else if REMEMBERS && head.y != NONE {
            for (var n = 0u; n < head.x; n += 1u) {
                forget(pair_at(k, n));
                store_history(pair_at(k, n));
            }
        }
        check_turns(me);
    }
}
