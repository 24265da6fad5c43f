// Groups of targets walk the tree, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit vectors): the
// eight lanes look at the eight nodes three levels below one, and at the six between. Who is far enough goes into one list,
// leaves go into another; when a list is long, each lane loads an entry of it and the eight are passed round by broadcast.
const LANES: u32 = 8u;
const WORKGROUP: u32 = 8u;
const TARGETS: u32 = 4u;
const GROUP: u32 = 32u;
// Entries of the lists that are met together, and room for what a look at eight nodes adds. Powers of two: they are rings.
const FAR: u32 = 128u;
const NEAR: u32 = 64u;

var<workgroup> far: array<u32, 2u * FAR>;
var<workgroup> near: array<u32, 2u * NEAR>;

// What stands in the way of a lane's own body, or of nobody's: the way is not 0, and nothing is there.
fn meet_body(me: Particle, slot: u32, mine: u32, index: u32, b: vec4f, sum: ptr<function, Sum>) {
    let nobody = slot == mine || slot >= tree.count;
    let r = shortest(b.xyz - me.position);
    gather(me, Particle(index, b.xyz, select(b.w, 0.0, nobody)), select(r, vec3f(1.0), nobody), sum);
}

// Everybody of the group meets everybody else of it.
fn meet_own(first: u32, place: u32, a: Particle, b: Particle, c: Particle, d: Particle,
            sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let mine = first + place;
    for (var i = 0u; i < GROUP; i += 1u) {
        let slot = first + i;
        let you = body(min(slot, tree.count - 1u), true);
        let index = tree_id[min(slot, tree.count - 1u)];
        meet_body(a, slot, mine, index, you, sum_a);
        meet_body(b, slot, mine + LANES, index, you, sum_b);
        meet_body(c, slot, mine + 2u * LANES, index, you, sum_c);
        meet_body(d, slot, mine + 3u * LANES, index, you, sum_d);
    }
}

fn meet(index: u32, you: vec4f, a: Particle, b: Particle, c: Particle, d: Particle,
        sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let p = Particle(index, you.xyz, you.w);
    gather(a, p, shortest(p.position - a.position), sum_a);
    gather(b, p, shortest(p.position - b.position), sum_b);
    gather(c, p, shortest(p.position - c.position), sum_c);
    gather(d, p, shortest(p.position - d.position), sum_d);
}

fn meet_group(x: vec3f, g: Group, a: Particle, b: Particle, c: Particle, d: Particle,
              sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    distant(a, g, shortest(x - a.position), sum_a);
    distant(b, g, shortest(x - b.position), sum_b);
    distant(c, g, shortest(x - c.position), sum_c);
    distant(d, g, shortest(x - d.position), sum_d);
}

// What lane 0, 1, … holds; the lane of a broadcast must be a constant.
fn group0(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 0u), subgroupBroadcast(g.diagonal, 0u), subgroupBroadcast(g.mixed, 0u)); }
fn group1(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 1u), subgroupBroadcast(g.diagonal, 1u), subgroupBroadcast(g.mixed, 1u)); }
fn group2(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 2u), subgroupBroadcast(g.diagonal, 2u), subgroupBroadcast(g.mixed, 2u)); }
fn group3(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 3u), subgroupBroadcast(g.diagonal, 3u), subgroupBroadcast(g.mixed, 3u)); }
fn group4(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 4u), subgroupBroadcast(g.diagonal, 4u), subgroupBroadcast(g.mixed, 4u)); }
fn group5(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 5u), subgroupBroadcast(g.diagonal, 5u), subgroupBroadcast(g.mixed, 5u)); }
fn group6(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 6u), subgroupBroadcast(g.diagonal, 6u), subgroupBroadcast(g.mixed, 6u)); }
fn group7(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 7u), subgroupBroadcast(g.diagonal, 7u), subgroupBroadcast(g.mixed, 7u)); }

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(subgroup_invocation_id) place: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let first = min(mine * GROUP, tree.end - 1u);
    let last = tree.count - 1u;
    let k = first + place;
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

    // Nodes that are still to be looked at, as bits: eight children of a node are a byte, those of the lowest come last.
    var waits = vec3u();
    var node = 1u;
    var depth = 0u;
    var levels = (tree.height + 2u) % 3u + 1u;
    let top = levels;
    var more = tree.leaves > GROUP / LEAF;
    var listed = vec2u();
    var met = vec2u();
    var spent = 0u;
    while (more || any(met < listed)) && spent <= MOST {
        // Looks at nodes until a list is long, or until there are none.
        while more && listed.x - met.x < FAR && listed.y - met.y < NEAR && spent <= MOST {
            let below = depth + levels;
            let n = (node << levels) + place;
            let real = place < (1u << levels) && exists(n, below);
            let holds = own >> (tree.height - below) == n;
            // The nodes between: first those of the level above, then those of the next.
            let upper = place >= 4u;
            let m = select((node << (levels - 1u)) + place, 2u * node + place - 4u, upper);
            let between = select(below - 1u, depth + 1u, upper);
            let some = select(place < (1u << (levels - 1u)) && levels > 1u, place < 6u && levels == 3u, upper);
            let also = some && exists(m, between) && own >> (tree.height - between) != m;
            let wide = also && !opens(select(1u, m, also), here);
            let above = subgroupBallot(wide).x;
            let taken = (((above >> (place / 2u)) | (above >> (4u + place / 4u))) & 1u) != 0u;
            let shut = real && !taken && !holds && !opens(select(1u, n, real), here);
            let leaf = below == tree.height;
            let far_wide = wide && (upper || ((above >> (4u + place / 2u)) & 1u) == 0u);

            let wides = subgroupBallot(far_wide).x;
            if far_wide { far[(listed.x + countOneBits(wides & lower)) % (2u * FAR)] = m; }
            listed.x += countOneBits(wides);
            let shuts = subgroupBallot(shut).x;
            if shut { far[(listed.x + countOneBits(shuts & lower)) % (2u * FAR)] = n; }
            listed.x += countOneBits(shuts);
            let others = real && !taken && !shut;
            let leaves = subgroupBallot(others && leaf).x;
            if others && leaf { near[(listed.y + countOneBits(leaves & lower)) % (2u * NEAR)] = n - (1u << tree.height); }
            listed.y += countOneBits(leaves);
            // The group itself has met.
            let itself = holds && below + 3u == tree.height;
            var open = subgroupBallot(others && !leaf && !itself).x;
            open = select(open, open << (1u << levels), levels < 3u);
            if open != 0u {
                waits = (waits << vec3u(8u)) | vec3u(open, waits.x >> 24u, waits.y >> 24u);
                node = n - place;
                depth = below;
            }
            while (waits.x & 255u) == 0u && depth > top {
                waits = (waits >> vec3u(8u)) | vec3u(waits.y << 24u, waits.z << 24u, 0u);
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
        let ends = select(listed, listed - (listed - met) % vec2u(LANES, LANES / LEAF), vec2<bool>(more));
        var part_a = Sum();
        var part_b = Sum();
        var part_c = Sum();
        var part_d = Sum();
        for (; met.x < ends.x; met.x += LANES) {
            let n = far[min(met.x + place, ends.x - 1u) % (2u * FAR)];
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
            let slot = near[min(entry, ends.y - 1u) % (2u * NEAR)] * LEAF + place % LEAF;
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
    if spent > MOST { atomicMin(&alarm[2], a.index); }
    if k < tree.end && acts_on(a) { deliver(a, sum_a); }
    if k + LANES < tree.end && acts_on(b) { deliver(b, sum_b); }
    if k + 2u * LANES < tree.end && acts_on(c) { deliver(c, sum_c); }
    if k + 3u * LANES < tree.end && acts_on(d) { deliver(d, sum_d); }
}
