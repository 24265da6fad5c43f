// Pairs in range, slot by slot: row 0 has the number of pairs of slot k, and the n-th is in row n, so that invocations side
// by side read side by side.
struct Sum { number: u32 }

@group(3) @binding(2) var<storage, read_write> pairs: array<vec4f>; // V g r, and the neighbour's slot

// Slots of a row, and rows of neighbours.
override STRIDE: u32 = 1u;
override ROOM: u32 = 1u;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    // An integer below 2²⁴ is exact.
    (*sum).number += 1u;
    if (*sum).number <= ROOM { pairs[(*sum).number * STRIDE + me.slot].w = f32(you.slot); }
}

fn finish(me: Particle, sum: Sum) {
    pairs[me.slot].w = f32(min(sum.number, ROOM));
    // There is room for twice as many as at rest.
    if sum.number > ROOM { atomicMin(&alarm[2], me.index); }
}
