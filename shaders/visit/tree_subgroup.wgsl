// Groups of targets walk the tree, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit vectors): the
// eight lanes look at the eight nodes three levels below one, and at the six between. Who is far enough goes into one list,
// leaves go into another; when a list is long, each lane loads an entry of it and the eight are passed round by broadcast.
const WORKGROUP: u32 = 8u;
// Entries of the lists that are met together, and room for what a look at eight nodes adds. Powers of two: they are rings.
const FAR: u32 = 128u;
const NEAR: u32 = 64u;

// First the far groups, then the leaves.
var<workgroup> list: array<u32, 2u * FAR + 2u * NEAR>;

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(subgroup_invocation_id) place: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let first = min(mine * GROUP, tree.end - 1u);
    let last = tree.count - 1u;
    let k = mine * GROUP + place;
    let a = target_of(min(k, last));
    let b = target_of(min(k + LANES, last));
    let c = target_of(min(k + 2u * LANES, last));
    let d = target_of(min(k + 3u * LANES, last));
    var sum_a = Sum();
    var sum_b = Sum();
    var sum_c = Sum();
    var sum_d = Sum();
    meet_own(first, place, a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);

    let low = subgroupMin(min(min(a.position, b.position), min(c.position, d.position)));
    let high = subgroupMax(max(max(a.position, b.position), max(c.position, d.position)));
    let here = Place(0.5 * (low + high), 0.5 * (high - low), demand_of(mine));
    // The leaf at which the group begins: what is above it holds the group.
    let own = (1u << tree.height) + first / LEAF;
    let lower = (1u << place) - 1u;

    // Nodes that are still to be looked at, as bits: eight children of a node are a byte, those of the lowest come last. Of
    // 25 levels at most, the lowest three are leaves' and wait for nobody: that leaves eight bytes.
    var waits = vec2u();
    var node = 1u;
    var depth = 0u;
    var levels = (tree.height + 2u) % 3u + 1u;
    let top = levels;
    var more = tree.leaves > GROUP / LEAF;
    var listed = vec2u();
    var met = vec2u();
    var spent = 0u;
    while more && spent <= MOST {
        // Looks at nodes until a list is long, or until there are none.
        while more && listed.x - met.x < FAR
            && listed.y - met.y < NEAR && spent <= MOST {
            let below = depth + levels;
            let n = (node << levels) + place;
            let real = exists(n, below);
            let holds = own >> (tree.height - below) == n;
            let itself = holds && below + 3u == tree.height;
            // A node between stands on a lane that is below it: of the level above on the even ones, of the next on 1 and 5.
            let upper = (place & 3u) == 1u;
            let m = select(n >> 1u, n >> 2u, upper);
            let between = select(below - 1u, depth + 1u, upper);
            let some = select((place & 1u) == 0u, levels == 3u, upper);
            let also = some && exists(m, between) && own >> (tree.height - between) != m;
            let wide = also && !opens(select(1u, m, also), here);
            let above = subgroupBallot(wide).x;
            let over = (above >> ((place & 4u) + 1u)) & 1u;
            let taken = (over | (above >> (place & 6u))) & 1u;
            let shut = real && taken == 0u && !holds && !opens(select(1u, n, real), here);
            let far = shut || wide && (upper || over == 0u);
            let others = real && taken == 0u && !shut && !itself;
            let leaf = below == tree.height;

            let fars = subgroupBallot(far).x;
            let rest = subgroupBallot(others).x;
            let at_far = (listed.x + countOneBits(fars & lower)) % (2u * FAR);
            let at_near = 2u * FAR + (listed.y + countOneBits(rest & lower)) % (2u * NEAR);
            if far || others && leaf { list[select(at_near, at_far, far)] = select(n, m, wide); }
            listed.x += countOneBits(fars);
            listed.y += select(0u, countOneBits(rest), leaf);
            let open = select(rest << select(0u, 1u << levels, levels < 3u), 0u, leaf);
            if open != 0u {
                waits = (waits << vec2u(8u)) | vec2u(open, waits.x >> 24u);
                node = n - place;
                depth = below;
            }
            while (waits.x & 255u) == 0u && depth > top {
                waits = (waits >> vec2u(8u)) | vec2u(waits.y << 24u, 0u);
                node = node / 8u;
                depth -= 3u;
                spent += 1u;
            }
            more = (waits.x & 255u) != 0u;
            node = (node & ~7u) + countTrailingZeros(waits.x & 255u);
            waits.x &= waits.x - 1u;
            levels = 3u;
            spent += 1u;
        }
        workgroupBarrier();
        // Whole eights are met, and at the end what is left.
        let ends = select(listed, listed - listed % vec2u(LANES, LANES / LEAF), vec2<bool>(more));
        var part_a = Sum();
        var part_b = Sum();
        var part_c = Sum();
        var part_d = Sum();
        for (; met.x < ends.x; met.x += LANES) {
            let n = list[min(met.x + place, ends.x - 1u) % (2u * FAR)];
            let x = tree_center[n].xyz;
            let g = group_at(n, met.x + place < ends.x);
            meet_group(subgroupBroadcast(x, 0u), group0(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 1u), group1(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 2u), group2(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 3u), group3(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 4u), group4(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 5u), group5(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 6u), group6(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet_group(subgroupBroadcast(x, 7u), group7(g), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            spent += 1u;
        }
        for (; met.y < ends.y; met.y += LANES / LEAF) {
            let entry = met.y + place / LEAF;
            let leaf = list[2u * FAR + min(entry, ends.y - 1u) % (2u * NEAR)];
            let slot = (leaf - (1u << tree.height)) * LEAF + place % LEAF;
            let p = body(min(slot, last), slot < tree.count && entry < ends.y);
            let i = tree_id[min(slot, last)];
            meet(subgroupBroadcast(i, 0u), subgroupBroadcast(p, 0u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 1u), subgroupBroadcast(p, 1u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 2u), subgroupBroadcast(p, 2u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 3u), subgroupBroadcast(p, 3u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 4u), subgroupBroadcast(p, 4u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 5u), subgroupBroadcast(p, 5u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 6u), subgroupBroadcast(p, 6u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            meet(subgroupBroadcast(i, 7u), subgroupBroadcast(p, 7u), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            spent += 1u;
        }
        met = ends;
        merge(&sum_a, part_a);
        merge(&sum_b, part_b);
        merge(&sum_c, part_c);
        merge(&sum_d, part_d);
        spent += 3u;
        workgroupBarrier();
    }
    if more { atomicMin(&alarm[2], a.index); }
    if k < tree.end && acts_on(a) { deliver(a, sum_a); }
    if k + LANES < tree.end && acts_on(b) { deliver(b, sum_b); }
    if k + 2u * LANES < tree.end && acts_on(c) { deliver(c, sum_c); }
    if k + 3u * LANES < tree.end && acts_on(d) { deliver(d, sum_d); }
    check_turns(a);
}
