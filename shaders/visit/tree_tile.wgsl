// Groups of targets walk the tree, for GPUs: a workgroup for each, a lane for each target. Pending nodes are a stack in
// workgroup memory; each lane tests one, and far nodes, and leaves, go into lists. When a list is long, its entries
// pass through workgroup memory and every lane evaluates them. Places in the lists are counted by votes, in the order of lanes.
const WORKGROUP: u32 = 32u;
// The stack is in the order of levels, the lowest on top, and so it stays: children are put where their parents were, in
// their order. A level's nodes are taken when fewer than a workgroup stand above them, and those are taken with them;
// so whenever children come to a level it is empty, and they are twice a workgroup at most.
override WAITING: u32; // twice a workgroup for each level, or all of its nodes
// What votes are about.
const FAR: u32 = 0u;
const NEAR: u32 = 1u;
const OPEN: u32 = 2u;

var<workgroup> waits: array<u32, WAITING>;
var<workgroup> votes: array<atomic<u32>, 3>;
var<workgroup> added: vec3u;
var<workgroup> last_opened: bool;
// Less than a tile is left when as many nodes as there are lanes are tested.
var<workgroup> fars: array<u32, 2u * WORKGROUP>;
var<workgroup> leaves: array<u32, 2u * WORKGROUP>;
// What is evaluated together, in whole vectors: centre and mass of a group, or of a body; a group's second moments.
var<workgroup> places: array<vec4f, WORKGROUP>;
var<workgroup> moments_a: array<vec4f, WORKGROUP>; // xx, yy, zz, xy
var<workgroup> moments_b: array<vec4f, WORKGROUP>; // xz, yz, half the trace
var<workgroup> ids: array<u32, WORKGROUP>;

fn votes_for(what: u32) -> u32 { return countOneBits(atomicLoad(&votes[what])); }

// The interaction of a lane's target with an entry of the tile.
fn meet_group(me: Particle, i: u32, sum: ptr<function, Sum>) {
    let p = places[i];
    let a = moments_a[i];
    let b = moments_b[i];
    distant(me, Group(p.w, a.xyz, vec3f(a.w, b.xy), b.z), shortest(p.xyz - me.position), sum);
}
fn meet_body(me: Particle, i: u32, sum: ptr<function, Sum>) {
    let p = places[i];
    gather(me, Particle(ids[i], p.xyz, p.w), shortest(p.xyz - me.position), sum);
}

// So many far groups, four in a turn while there are four.
fn meet_groups(me: Particle, some: u32, sum: ptr<function, Sum>) {
    var part = Sum();
    let whole = some - some % 4u;
    var i = 0u;
    for (; i < whole; i += 4u) {
        meet_group(me, i, &part);
        meet_group(me, i + 1u, &part);
        meet_group(me, i + 2u, &part);
        meet_group(me, i + 3u, &part);
    }
    for (; i < some; i += 1u) { meet_group(me, i, &part); }
    merge(sum, part);
}
// Whole leaves, four bodies in a turn.
fn meet_leaves(me: Particle, some: u32, sum: ptr<function, Sum>) {
    var part = Sum();
    for (var i = 0u; i < some * LEAF; i += 4u) {
        meet_body(me, i, &part);
        meet_body(me, i + 1u, &part);
        meet_body(me, i + 2u, &part);
        meet_body(me, i + 3u, &part);
    }
    merge(sum, part);
}

// A body into the tile. Beyond the last slot it is any, and not evaluated.
fn load_body(lane: u32, slot: u32) {
    places[lane] = tree_body[slot];
    ids[lane] = tree_id[slot];
}

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    if !is_wanted(mine) { return; }
    let last = world.count - 1u;
    let k = mine * GROUP + lane;
    let me = target_of(min(k, last));
    let here = place_of(mine, min(mine * GROUP, last));
    let own = leaf_of(mine);
    var sum = Sum();
    var far = 0u;
    var near = 0u;
    var top = 1u;
    // The last leaf, where it is not full.
    let rest = world.count % LEAF;
    var partial = 0u;
    if rest != 0u { partial = (1u << tree.height) + last / LEAF; }
    if lane == 0u {
        waits[0] = 1u;
        last_opened = false;
    }
    while top > 0u {
        let some = min(top, WORKGROUP);
        top -= some;
        if lane <= OPEN { atomicStore(&votes[lane], 0u); }
        workgroupBarrier();
        let node = waits[top + lane];
        let depth = firstLeadingBit(node);
        let real = lane < some && exists(node, depth);
        let itself = real && is_own(node, depth, own);
        let open = itself || (real && reaches_any(node, here));
        let kind = select(FAR, select(OPEN, NEAR, depth == tree.height), open);
        // The leaves of the group itself, and the last one where it is not full, are evaluated at the end.
        let listed = real && !(kind == NEAR && (itself || node == partial));
        if open && !itself && node == partial { last_opened = true; }
        if listed { atomicOr(&votes[kind], 1u << lane); }
        workgroupBarrier();
        let before = countOneBits(atomicLoad(&votes[kind]) & ((1u << lane) - 1u));
        if listed && kind == FAR { fars[far + before] = node; }
        if listed && kind == NEAR { leaves[near + before] = node; }
        if listed && kind == OPEN {
            waits[top + 2u * before] = 2u * node;
            waits[top + 2u * before + 1u] = 2u * node + 1u;
        }
        if lane == 0u { added = vec3u(votes_for(FAR), votes_for(NEAR), votes_for(OPEN)); }
        let more = workgroupUniformLoad(&added);
        far += more[FAR];
        near += more[NEAR];
        top += 2u * more[OPEN];
        // Whole tiles are evaluated, and at the end what is left.
        let done = top == 0u;
        while far >= select(WORKGROUP, 1u, done) {
            let full = min(far, WORKGROUP);
            far -= full;
            let n = fars[far + lane];
            workgroupBarrier();
            let g = group_at(n);
            places[lane] = vec4f(tree_center[n].xyz, g.mass);
            moments_a[lane] = vec4f(g.diagonal, g.mixed.x);
            moments_b[lane] = vec4f(g.mixed.yz, g.half_trace, 0.0);
            workgroupBarrier();
            meet_groups(me, full, &sum);
        }
        while near >= select(WORKGROUP / LEAF, 1u, done) {
            let full = min(near, WORKGROUP / LEAF);
            near -= full;
            let leaf = leaves[near + lane / LEAF];
            workgroupBarrier();
            load_body(lane, (leaf - (1u << tree.height)) * LEAF + lane % LEAF);
            workgroupBarrier();
            meet_leaves(me, full, &sum);
        }
    }
    var part = Sum();
    let others = workgroupUniformLoad(&last_opened);
    load_body(lane, (partial - (1u << tree.height)) * LEAF + lane);
    workgroupBarrier();
    for (var i = 0u; i < select(0u, rest, others); i += 1u) { meet_body(me, i, &part); }
    workgroupBarrier();
    load_body(lane, mine * GROUP + lane);
    workgroupBarrier();
    for (var i = 0u; i < min(GROUP, world.count - mine * GROUP); i += 1u) {
        if i != lane { meet_body(me, i, &part); }
    }
    merge(&sum, part);
    if k < last_target() && acts_on(me) { deliver(me, sum); }
    check_turns(me);
}
