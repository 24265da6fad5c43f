// Everybody meets who is within a range, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit
// vectors). Those who stand side by side in a row of cells walk it together: each lane loads one candidate of all their
// rows taken as one, and the eight are passed round by broadcast. What of that is not around a lane fails its test of
// distance, so everybody meets the same, in the same order, as alone.
const WORKGROUP: u32 = 64u;
const LANES: u32 = 8u;

// What lane 0, 1, … holds; the lane of a broadcast must be a constant.
fn told0(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 0u), subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.velocity, 0u)); }
fn told1(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 1u), subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.velocity, 1u)); }
fn told2(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 2u), subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.velocity, 2u)); }
fn told3(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 3u), subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.velocity, 3u)); }
fn told4(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 4u), subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.velocity, 4u)); }
fn told5(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 5u), subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.velocity, 5u)); }
fn told6(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 6u), subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.velocity, 6u)); }
fn told7(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 7u), subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.velocity, 7u)); }

// Whether all lanes look at the same rows, and at parts of them that do not reach round the seam into each other.
fn together(a: Around) -> bool {
    let head = subgroupBroadcast(a.cell, 0u);
    let rows = all(a.cell.yz == head.yz) && all(a.reach == subgroupBroadcast(a.reach, 0u));
    let apart = max(a.cell.x, head.x) - min(a.cell.x, head.x);
    return subgroupAll(rows && (apart == 0u || a.span.x == grid.cells.x || (apart <= 1u && a.span.x + 4u <= grid.cells.x)));
}

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32,
        @builtin(subgroup_invocation_id) place: u32) {
    // Lanes behind the last target repeat it; nothing of theirs is stored.
    let mine = grid.first + folded(group, groups) * WORKGROUP + lane;
    let k = min(mine, grid.end - 1u);
    let me = target_of(k);
    let awake = mine < grid.end && acts_on(me);
    var sum = Sum();
    if subgroupAny(awake) {
        let a = around(me.position);
        if together(a) {
            let part = parts(a);
            let first = subgroupMin(part.x);
            let last = subgroupMax(part.y);
            let span = subgroupBroadcast(a.span, 0u);
            var seen = 0u;
            for (var z = 0u; z < span.z; z += 1u) {
                for (var y = 0u; y < span.y; y += 1u) {
                    for (var p = first; p < last; p += 1u) {
                        let s = slots_of(a, z, y, p);
                        let wanted = s.x < s.y;
                        let start = subgroupMin(select(0xffffffffu, s.x, wanted));
                        let stop = subgroupMax(select(0u, s.y, wanted));
                        seen += max(stop, start) - start;
                        let end = select(0u, stop, seen <= MOST);
                        for (var slot = start; slot < end; slot += LANES) {
                            let q = candidate(min(slot + place, end - 1u));
                            consider(k, slot, end, me, told0(q), &sum);
                            consider(k, slot + 1u, end, me, told1(q), &sum);
                            consider(k, slot + 2u, end, me, told2(q), &sum);
                            consider(k, slot + 3u, end, me, told3(q), &sum);
                            consider(k, slot + 4u, end, me, told4(q), &sum);
                            consider(k, slot + 5u, end, me, told5(q), &sum);
                            consider(k, slot + 6u, end, me, told6(q), &sum);
                            consider(k, slot + 7u, end, me, told7(q), &sum);
                        }
                    }
                }
            }
            if awake && seen > MOST { atomicMin(&alarm[2], me.index); }
        } else {
            walk(k, me, &sum);
        }
    }
    if awake { deliver(me, sum); }
}
