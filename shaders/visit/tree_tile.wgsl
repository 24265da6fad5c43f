// Groups of targets walk the tree, for GPUs: a workgroup for each, a lane for each target. Pending nodes are a stack in
// workgroup memory; each lane tests one, and far nodes, and leaves, go into lists. When a list is long, its entries
// pass through workgroup memory and every lane evaluates them. Places in the lists are counted by votes, in the order of lanes.
const WORKGROUP: u32 = 32u;
// The stack is in the order of levels, the lowest on top, and so it stays: children are put where their parents were, in
// their order. A level's nodes are taken when fewer than a workgroup stand above them, and those are taken with them;
// so whenever children come to a level it is empty, and they are twice a workgroup at most. Below the root of a tree of
// 2²⁷ bodies there are 25 levels.
const WAITING: u32 = 2u * WORKGROUP * 25u;
// What votes are about.
const FAR: u32 = 0u;
const NEAR: u32 = 1u;
const OPEN: u32 = 2u;

var<workgroup> waits: array<u32, WAITING>;
var<workgroup> votes: array<atomic<u32>, 3>;
var<workgroup> added: vec3u;
// Less than a tile is left when as many nodes as there are lanes are tested.
var<workgroup> fars: array<u32, 2u * WORKGROUP>;
var<workgroup> leaves: array<u32, 2u * WORKGROUP>;
var<workgroup> tile: array<Group, WORKGROUP>;
var<workgroup> places: array<vec4f, WORKGROUP>;
var<workgroup> slots: array<u32, WORKGROUP>;
var<workgroup> ids: array<u32, WORKGROUP>;

fn votes_for(what: u32) -> u32 { return countOneBits(atomicLoad(&votes[what])); }

// The interaction of a lane's target with the tile.
fn meet_groups(me: Particle, some: u32, sum: ptr<function, Sum>) {
    var part = Sum();
    for (var i = 0u; i < some; i += 1u) { distant(me, tile[i], shortest(places[i].xyz - me.position), &part); }
    merge(sum, part);
}

fn meet_bodies(me: Particle, mine: u32, some: u32, sum: ptr<function, Sum>) {
    var part = Sum();
    for (var i = 0u; i < some; i += 1u) {
        let p = places[i];
        if slots[i] != mine && slots[i] < world.count { gather(me, Particle(ids[i], p.xyz, p.w), shortest(p.xyz - me.position), &part); }
    }
    merge(sum, part);
}

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let last = world.count - 1u;
    let k = mine * GROUP + lane;
    let me = target_of(min(k, last));
    let here = place_of(mine, min(mine * GROUP, last));
    let own = leaf_of(mine);
    var sum = Sum();
    var far = 0u;
    var near = 0u;
    var top = 1u;
    if lane == 0u { waits[0] = 1u; }
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
        if real { atomicOr(&votes[kind], 1u << lane); }
        workgroupBarrier();
        let before = countOneBits(atomicLoad(&votes[kind]) & ((1u << lane) - 1u));
        if real && kind == FAR { fars[far + before] = node; }
        if real && kind == NEAR { leaves[near + before] = node; }
        if real && kind == OPEN {
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
            tile[lane] = group_at(n);
            places[lane] = tree_center[n];
            workgroupBarrier();
            meet_groups(me, full, &sum);
        }
        while near >= select(WORKGROUP / LEAF, 1u, done) {
            let full = min(near, WORKGROUP / LEAF);
            near -= full;
            let leaf = leaves[near + lane / LEAF];
            let slot = (leaf - (1u << tree.height)) * LEAF + lane % LEAF;
            workgroupBarrier();
            places[lane] = tree_body[min(slot, last)];
            ids[lane] = tree_id[min(slot, last)];
            slots[lane] = slot;
            workgroupBarrier();
            meet_bodies(me, k, full * LEAF, &sum);
        }
    }
    if k < last_target() && acts_on(me) { deliver(me, sum); }
    check_turns(me);
}
