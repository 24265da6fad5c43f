// Everybody meets who is within a range, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit
// vectors). Those who stand side by side in a row of cells walk together: each lane loads one candidate of all their
// cells taken as one, and the eight are passed round by broadcast. What of that is not around a lane fails its test of
// distance, so everybody meets the same, in the same order, as alone.
const WORKGROUP: u32 = 64u;
const LANES: u32 = 8u;
const NOBODY: u32 = 0xffffffffu;
// Cells between those who walk together, at most: more, and most of what they look at is not theirs.
const APART: u32 = 3u;

// What lane 0, 1, … holds; the lane of a broadcast must be a constant.
fn told0(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 0u), subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.velocity, 0u)); }
fn told1(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 1u), subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.velocity, 1u)); }
fn told2(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 2u), subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.velocity, 2u)); }
fn told3(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 3u), subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.velocity, 3u)); }
fn told4(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 4u), subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.velocity, 4u)); }
fn told5(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 5u), subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.velocity, 5u)); }
fn told6(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 6u), subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.velocity, 6u)); }
fn told7(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 7u), subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.velocity, 7u)); }

fn consider(k: u32, slot: u32, end: u32, me: Particle, you: Particle, image: bool, mine: bool, sum: ptr<function, Sum>) {
    var r = you.position - me.position;
    if image { r = shortest(r); }
    if mine && slot < end && in_range(r) && !same(k, slot, me) { gather(me, you, r, sum); }
}

fn stretch(k: u32, me: Particle, place: u32, start: u32, end: u32, image: bool, with_me: bool, sum: ptr<function, Sum>) {
    for (var slot = start; slot < end; slot += LANES) {
        let q = candidate(min(slot + place, end - 1u));
        consider(k, slot, end, me, told0(q), image, with_me, sum);
        consider(k, slot + 1u, end, me, told1(q), image, with_me, sum);
        consider(k, slot + 2u, end, me, told2(q), image, with_me, sum);
        consider(k, slot + 3u, end, me, told3(q), image, with_me, sum);
        consider(k, slot + 4u, end, me, told4(q), image, with_me, sum);
        consider(k, slot + 5u, end, me, told5(q), image, with_me, sum);
        consider(k, slot + 6u, end, me, told6(q), image, with_me, sum);
        consider(k, slot + 7u, end, me, told7(q), image, with_me, sum);
    }
}

// Whether I look at the rows of another, at parts of them that do not reach round the seam into each other.
fn beside(a: Around, lane: u32) -> bool {
    let cell = subgroupShuffle(a.cell, lane);
    let rows = all(a.cell.yz == cell.yz) && all(a.reach == subgroupShuffle(a.reach, lane));
    let apart = max(a.cell.x, cell.x) - min(a.cell.x, cell.x);
    let wide = grid.cells.x >= a.span.x + 2u * APART;
    return rows && (apart == 0u || a.span.x == grid.cells.x || (apart <= APART && wide));
}

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32,
        @builtin(subgroup_invocation_id) place: u32) {
    // Lanes behind the last target repeat it; nothing of theirs is stored.
    let mine = grid.first + folded(group, groups) * WORKGROUP + lane;
    let k = min(mine, grid.end - 1u);
    let me = target_of(k);
    let awake = mine < grid.end && acts_on(me);
    let a = around(me.position);
    let narrow = few(a.span);
    var sum = Sum();
    var waits = awake;
    var seen = 0u;
    for (var turn = 0u; turn < LANES && subgroupAny(waits); turn += 1u) {
        // The first who waits, and all who can go along.
        let leader = subgroupMin(select(NOBODY, place, waits));
        let with_me = waits && beside(a, leader);
        let lower = subgroupMin(select(vec3u(NOBODY), a.lower, vec3<bool>(with_me) & (a.lower < a.upper)));
        let upper = subgroupMax(select(vec3u(0u), a.upper, vec3<bool>(with_me) & (a.lower < a.upper)));
        let first = subgroupShuffle(a.first, leader);
        let span = subgroupShuffle(a.span, leader);
        for (var z = 0u; z < span.z; z += 1u) {
            for (var y = 0u; y < span.y; y += 1u) {
                let r = row(first, z, y);
                let seam = subgroupAny(with_me && (narrow || behind(a, z, y)));
                for (var p = 0u; p < PARTS; p += 1u) {
                    if lower[p] < upper[p] {
                        let start = starts[r + lower[p]];
                        let end = starts[r + upper[p]];
                        seen += end - start;
                        if seen <= MOST {
                            // One of the two loops has nothing to do.
                            let image = PERIODIC && (seam || p != MIDDLE);
                            stretch(k, me, place, start, select(end, start, image), false, with_me, &sum);
                            stretch(k, me, place, start, select(start, end, image), true, with_me, &sum);
                        }
                    }
                }
            }
        }
        if with_me && seen > MOST { atomicMin(&alarm[2], me.index); }
        waits = waits && !with_me;
    }
    if awake { deliver(me, sum); }
}
