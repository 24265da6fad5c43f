// From the order of the walk to that of ids: sixteen neighbours count which ids are lower than theirs. Sums over neighbours have
// one order then, whenever the list was built.
@group(2) @binding(8) var<storage, read_write> list: array<vec4u>;
@group(2) @binding(11) var<storage, read> list_found: array<vec4u>;
@group(2) @binding(12) var<storage, read_write> list_origin: array<vec4f>;

override ROOM: u32 = 4u;
// Whether the box changes.
override ELASTIC: bool = false;
const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;

fn ones(lower: vec4<bool>) -> vec4u { return select(vec4u(0u), vec4u(1u), lower); }

// How many of four are lower than each of four.
fn lower(a: vec4u, than: vec4u) -> vec4u {
    return ones(vec4u(a.x) < than) + ones(vec4u(a.y) < than) + ones(vec4u(a.z) < than) + ones(vec4u(a.w) < than);
}

// The n-th four of a row; behind its end, what is larger than any id.
fn four(k: u32, n: u32, end: u32) -> vec4u {
    if 4u * n < end { return list_found[(1u + n) * world.capacity + k]; }
    return vec4u(NONE);
}

fn put(k: u32, place: u32, id: u32) {
    if id != NONE { list[(1u + place / 4u) * world.capacity + k][place % 4u] = id; }
}

fn put_four(k: u32, place: vec4u, id: vec4u) {
    put(k, place.x, id.x);
    put(k, place.y, id.y);
    put(k, place.z, id.z);
    put(k, place.w, id.w);
}

// A row without room for all is empty: the run ends with an error that names its particle.
fn length(found: vec4u) -> u32 { return select(0u, found.x, found.x <= ROOM); }

// The head of a row, and where the particle of that id is, not slot, as the list is built.
fn head(k: u32, found: vec4u) {
    list[k] = vec4u(length(found), found.yzw);
    let side = select(1.0, world.period.x, ELASTIC);
    list_origin[k] = vec4f(position[k].xyz, side * f32(is_active(k)));
    if found.x > atomicLoad(&list_state[0].longest) { atomicMax(&list_state[0].longest, found.x); }
    if length(found) < found.x { atomicMax(&list_state[0].full, ~found.y); }
}

@compute @workgroup_size(WORKGROUP)
fn order(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    // Layer n of the dispatch has the n-th sixteen of each row.
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < world.count {
        var found = vec4u(0u, NONE, 0u, 0u);
        if k < present() { found = list_found[k]; }
        if group.z == 0u { head(k, found); }
        let end = length(found);
        let first = 4u * group.z;
        if 4u * first < end {
            let a = four(k, first, end);
            let b = four(k, first + 1u, end);
            let c = four(k, first + 2u, end);
            let d = four(k, first + 3u, end);
            var place_a = vec4u(0u);
            var place_b = vec4u(0u);
            var place_c = vec4u(0u);
            var place_d = vec4u(0u);
            for (var n = 0u; n < end; n += 4u) {
                let others = list_found[(1u + n / 4u) * world.capacity + k];
                place_a += lower(others, a);
                place_b += lower(others, b);
                place_c += lower(others, c);
                place_d += lower(others, d);
            }
            put_four(k, place_a, a);
            put_four(k, place_b, b);
            put_four(k, place_c, c);
            put_four(k, place_d, d);
        }
    }
}
