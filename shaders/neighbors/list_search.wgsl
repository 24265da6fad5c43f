// Neighbours within range + skin, in the order in which cells are walked. Row 0 of the list has a head for each slot of the
// grid: how many neighbours there are, and of which particle. Each further row has four of them, so that invocations side by
// side read side by side.
struct Sum { number: u32 }

@group(2) @binding(11) var<storage, read_write> list_found: array<vec4u>;

// Range + skin, and how many neighbours there is room for: a multiple of four.
override REACH: f32 = 1.0;
override ROOM: u32 = 4u;
const EMPTY: u32 = 0xffffffffu;

fn acts_on(me: Particle) -> bool { return true; }

fn put(slot: u32, n: u32, id: u32) { list_found[(1u + n / 4u) * world.capacity + slot][n % 4u] = id; }

// The grid searches slightly farther than the reach. The stored positions decide, and not their images in the box.
fn in_reach(me: Particle, you: Particle) -> bool {
    let way = shortest(stored(you) - stored(me));
    return way.x * way.x + way.y * way.y + way.z * way.z < REACH * REACH;
}

fn add(me: Particle, id: u32, sum: ptr<function, Sum>) {
    if (*sum).number < ROOM { put(me.slot, (*sum).number, id); }
    (*sum).number += 1u;
}

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if in_reach(me, you) { add(me, you.index, sum); }
}

fn deliver(k: u32, me: Particle, sum: Sum) {
    list_found[k] = vec4u(sum.number, me.index, 0u, 0u);
    // What is left of the last four is larger than any id.
    for (var n = min(sum.number, ROOM); n % 4u != 0u; n += 1u) { put(k, n, EMPTY); }
}
