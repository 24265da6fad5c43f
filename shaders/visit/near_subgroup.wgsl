// All pairs within a range, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit
// vectors). Adjacent particles of a row of cells search together: each lane loads one candidate of all their
// cells together, and the eight are passed round by broadcast. Candidates that are not in a lane's neighbourhood fail its test of
// distance, so each evaluates the same neighbours, in the same order, as by itself.
const LANES: u32 = 8u;
const WORKGROUP: u32 = 8u * LANES;
const NONE: u32 = 0xffffffffu;
// Ranges between particles that walk together, at most: more, and most of what they look at is not theirs.
const APART: u32 = 3u;

// Whether I look at the rows of another, at parts of them that do not reach round the seam into each other: particles that walk
// together stands up to twice APART from each other, on both sides of the leader.
fn beside(a: Around, lane: u32) -> bool {
    let cell = subgroupShuffle(a.cell, lane);
    let other = subgroupShuffle(a.reach, lane);
    let rows = all(a.cell.yz == cell.yz) && all(a.reach == other);
    let apart = max(a.cell.x, cell.x) - min(a.cell.x, cell.x);
    let most = APART * grid.fine.x;
    return rows && (apart == 0u || (apart <= most && grid.cells.x > 2u * (a.reach.x + most)));
}

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32,
        @builtin(subgroup_invocation_id) place: u32) {
    // Lanes after the last target repeat it; their results are not stored.
    let mine = grid.first + folded(group, groups) * WORKGROUP + lane;
    let k = min(mine, grid.end - 1u);
    let me = target_of(k);
    let awake = mine < min(grid.end, present()) && acts_on(me);
    let a = around(me.position);
    var sum = Sum();
    var waits = awake;
    var walked = 0u;
    loop {
        // Of the iterations that an invocation's loops may take, those before this one had some. Two searches of MOST are all.
        let spent = max(walked, MOST) - MOST;
        var seen = spent;
        // The first that waits, and all that can go along.
        let first = subgroupMin(select(NONE, place, waits));
        let leader = first % LANES;
        let together = beside(a, leader);
        let with_me = waits && together;
        let low = subgroupMin(select(NONE, a.cell.x, with_me));
        let high = subgroupMax(select(0u, a.cell.x, with_me));
        let led = Around(subgroupShuffle(a.cell, leader), subgroupShuffle(a.reach, leader), subgroupShuffle(a.span, leader));
        let parts = select(1u, 3u, subgroupAny(with_me && seam(a)));
        let rows = select(0u, led.span.y * deep(led) * parts, first < LANES);
        // Every lane looks up one stretch; then all walk the eight. On these adapters a branch is never skipped, and a loop that has its
        // test before its end takes a turn more than it has.
        var base = 0u;
        loop {
            let i = base + place;
            let line = i / parts;
            var own = stretch(led, low, high, line / led.span.y, line % led.span.y, select(i % parts, 1u, parts == 1u));
            if i >= rows { own.end = own.start; }
            seen += subgroupAdd(STRETCH + own.end - own.start);
            var left = subgroupBallot(own.end > own.start && seen <= MOST).x;
            loop {
                let some = left != 0u;
                let next = select(0u, firstTrailingBit(left), some);
                left &= left - 1u;
                var slot = subgroupShuffle(own.start, next);
                let end = select(slot, subgroupShuffle(own.end, next), some);
                let behind = max(end, 1u);
                var shift = vec3f();
                if PERIODIC { shift = subgroupShuffle(own.shift, next); }
                loop {
                    let q = candidate(min(slot + place, behind - 1u));
                    consider_eight(k, slot, end, shift, me, q, with_me, &sum);
                    slot += LANES;
                    if slot >= end { break; }
                }
                if left == 0u { break; }
            }
            base += LANES;
            if base >= rows { break; }
        }
        if with_me && seen > MOST { atomicMin(&alarm[2], me.index); }
        walked += min(seen, MOST) - spent;
        waits = waits && !with_me;
        if !subgroupAny(waits) { break; }
    }
    if awake { deliver(k, me, sum); }
    check_turns(me);
}
