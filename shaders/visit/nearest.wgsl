// Each particle interacts with its k nearest neighbours (topological flocking: Ballerini et al. 2008), exactly: cells are
// looked at in growing cubes around me, until the last of my list is nearer than anything outside of the cube can be.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;

override COUNT: u32 = 7u;

const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;
// The largest square of a distance, and a distance beyond all others: infinity is no number for every compiler.
const LARGEST: f32 = 1e38;
const BEYOND: f32 = 1e19;

// Squares of distances, ascending, and ids; four at a time.
struct List { d0: vec4f, d1: vec4f, d2: vec4f, d3: vec4f, i0: vec4u, i1: vec4u, i2: vec4u, i3: vec4u }
// One that goes into the list, or falls out of it.
struct Entry { d: f32, id: u32 }

fn empty() -> List {
    let d = vec4f(LARGEST);
    let i = vec4u(NONE);
    return List(d, d, d, d, i, i, i, i);
}

// Puts an entry into four of the list; those after it move on, and the last is dropped.
fn insert(e: ptr<function, Entry>, d: ptr<function, vec4f>, i: ptr<function, vec4u>) {
    let tied = (vec4f((*e).d) == *d) & (vec4u((*e).id) < *i);
    let before = (vec4f((*e).d) < *d) | tied;
    let out = Entry((*d).w, (*i).w);
    let moved = vec4<bool>(false, before.xyz);
    let new_d = select(select(*d, vec4f((*e).d), before), vec4f(0.0, (*d).xyz), moved);
    let new_i = select(select(*i, vec4u((*e).id), before), vec4u(0u, (*i).xyz), moved);
    *d = new_d;
    *i = new_i;
    if before.w { *e = out; }
}

fn enter(list: ptr<function, List>, d: f32, id: u32) {
    var e = Entry(d, id);
    var d0 = (*list).d0; var i0 = (*list).i0;
    insert(&e, &d0, &i0);
    (*list).d0 = d0; (*list).i0 = i0;
    if COUNT > 4u {
        var d1 = (*list).d1; var i1 = (*list).i1;
        insert(&e, &d1, &i1);
        (*list).d1 = d1; (*list).i1 = i1;
    }
    if COUNT > 8u {
        var d2 = (*list).d2; var i2 = (*list).i2;
        insert(&e, &d2, &i2);
        (*list).d2 = d2; (*list).i2 = i2;
    }
    if COUNT > 12u {
        var d3 = (*list).d3; var i3 = (*list).i3;
        insert(&e, &d3, &i3);
        (*list).d3 = d3; (*list).i3 = i3;
    }
}

fn four(list: List, f: u32) -> vec4u {
    if f == 0u { return list.i0; }
    if f == 1u { return list.i1; }
    if f == 2u { return list.i2; }
    return list.i3;
}

fn last(list: List) -> f32 {
    var d = list.d0;
    if COUNT > 4u { d = list.d1; }
    if COUNT > 8u { d = list.d2; }
    if COUNT > 12u { d = list.d3; }
    return d[(COUNT - 1u) % 4u];
}

// How near to me a particle outside of the cube may be; rounding moves places by a part of a cell, far away by many.
fn outside(x: vec3f, a: Around) -> f32 {
    let slack = max(vec3f(0.00390625), abs(away(x)) * 0.000000238418579);
    let open = select(vec3f(BEYOND), (vec3f(a.reach) - slack) / grid.per_cell, a.span < grid.cells);
    return max(min(open.x, min(open.y, open.z)), 0.0);
}

fn look(me: Particle, slot: u32, s: Stretch, list: ptr<function, List>) {
    let r = shortest(sorted_position[slot].xyz - me.position);
    let id = sorted_id[slot];
    let d = min(r.x * r.x + r.y * r.y + r.z * r.z, LARGEST);
    if slot < s.end && id != me.index { enter(list, d, id); }
}

@compute @workgroup_size(WORKGROUP)
fn nearest(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = grid.first + folded(group, groups) * WORKGROUP + lane;
    if k < min(grid.end, present()) {
        let me = particle(sorted_id[k]);
        if acts_on(me) {
            let c = cell(wrapped(me.position));
            var list = empty();
            var seen = 0u;
            var reach = 1u;
            loop {
                let a = cube(c, vec3u(reach));
                let parts = select(vec2u(1u, 2u), vec2u(0u, 3u), seam(a));
                list = empty();
                for (var z = 0u; z < a.span.z; z += 1u) {
                    for (var y = 0u; y < a.span.y; y += 1u) {
                        for (var part = parts.x; part < parts.y; part += 1u) {
                            let s = stretch(a, c.x, c.x, z, y, part);
                            seen += STRETCH + s.end - s.start;
                            let end = select(s.start, s.end, seen <= MOST);
                            for (var slot = s.start; slot < end; slot += 4u) {
                                look(me, slot, s, &list);
                                look(me, slot + 1u, s, &list);
                                look(me, slot + 2u, s, &list);
                                look(me, slot + 3u, s, &list);
                            }
                        }
                    }
                }
                let bound = outside(me.position, a);
                if seen > MOST || all(a.span == grid.cells) || last(list) < bound * bound { break; }
                reach *= 2u;
            }
            if seen > MOST { atomicMin(&alarm[2], me.index); }
            var sum = Sum();
            for (var n = 0u; n < COUNT; n += 1u) {
                let id = four(list, n / 4u)[n % 4u];
                if id != NONE {
                    let you = particle(id);
                    gather(me, you, shortest(you.position - me.position), &sum);
                }
            }
            deliver(k, me, sum);
        }
        check_turns(me);
    }
}
