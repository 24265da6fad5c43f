// Groups of targets walk the tree, for adapters whose subgroups are all of eight lanes (lavapipe with 256-bit vectors): lanes
// test nodes side by side and list what is to be evaluated. When a list is long, each lane loads an entry of it and the eight are
// passed round by broadcast.
@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(subgroup_invocation_id) place: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let there = mine * GROUP < last_target() && is_wanted(mine);
    let first = select(tree.first, mine * GROUP, there);
    let last = world.count - 1u;
    let k = first + place;
    let a = target_of(min(k, last));
    let b = target_of(min(k + LANES, last));
    let c = target_of(min(k + 2u * LANES, last));
    let d = target_of(min(k + 3u * LANES, last));
    let low = subgroupMin(min(min(a.position, b.position), min(c.position, d.position)));
    let high = subgroupMax(max(max(a.position, b.position), max(c.position, d.position)));
    let here = place_at(first / GROUP, first, low, high);
    // The leaf at which the group begins: what is above it holds the group.
    let own = leaf_of(first / GROUP);

    var sum_a = Sum();
    var sum_b = Sum();
    var sum_c = Sum();
    var sum_d = Sum();
    var search = begun();
    // Those of the group itself are evaluated one by one. A group that does not walk meets nothing.
    var ours = select(0u, GROUP, there);
    let kept = first - tree.first;
    if tree.again > 0u {
        sum_a = tree_kept[kept + place].sum;
        sum_b = tree_kept[kept + place + LANES].sum;
        sum_c = tree_kept[kept + place + 2u * LANES].sum;
        sum_d = tree_kept[kept + place + 3u * LANES].sum;
        search = resumed(vec3u(tree_kept[kept].at, tree_kept[kept + 1u].at, tree_kept[kept + 2u].at));
        ours = 0u;
    }
    search.more = search.more && there;
    let walks = there && (tree.again == 0u || search.more);
    var lists = Lists();
    // So many entries have been evaluated, and of one of leaves this is left.
    var met = vec2u();
    var open = 0u;
    loop {
        // Visits nodes until a list is long, or until no node is left.
        var doubtful = false;
        while goes_on(search, met) {
            while goes_on(search, met) && !doubtful { doubtful = look(&search, &lists, here, own, place, false); }
            // Targets are asked in an iteration of the outer loop, of which there are few.
            if doubtful { look(&search, &lists, here, own, place, true); }
            doubtful = false;
        }
        // Whole eights are evaluated, and at the end what is left, one by one.
        let ends = !search.more || search.spent > MOST;
        let listed = search.listed;
        var part_a = Sum();
        var part_b = Sum();
        var part_c = Sum();
        var part_d = Sum();
        for (; met.x + LANES <= listed.x; met.x += LANES) {
            let n = lists.far[met.x / WORKGROUP % ROWS];
            let x = tree_center[n].xyz;
            meet_groups(x, group_at(n), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            search.spent += 1u;
        }
        for (; ends && met.x < listed.x; met.x += 1u) {
            let mine = lists.far[met.x / WORKGROUP % ROWS];
            let n = subgroupMax(select(0u, mine, place == met.x % WORKGROUP));
            meet_group(tree_center[n].xyz, group_at(n), a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            search.spent += 1u;
        }
        // The very last leaf may not be full, and is evaluated one by one.
        while search.leaves >= select(LANES / LEAF, LANES / LEAF + 1u, ends) {
            var leaf = 0u;
            for (var i = 0u; i < LANES / LEAF; i += 1u) {
                let next = next_leaf(&search, &lists, &met, &open);
                leaf = select(leaf, next, place / LEAF == i);
            }
            let slot = leaf * LEAF + place % LEAF;
            let p = tree_body[slot];
            meet_bodies(tree_id[slot], p, a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            search.spent += 2u + LANES / LEAF;
        }
        let single = ours + select(0u, search.leaves * LEAF, ends);
        var leaf = 0u;
        for (var i = 0u; i < single; i += 1u) {
            if i >= ours && (i - ours) % LEAF == 0u { leaf = next_leaf(&search, &lists, &met, &open); }
            let slot = select(leaf * LEAF + (i - ours) % LEAF, first + i, i < ours);
            meet_others(slot, k, a, b, c, d, &part_a, &part_b, &part_c, &part_d);
            search.spent += 1u;
        }
        ours = 0u;
        merge(&sum_a, part_a);
        merge(&sum_b, part_b);
        merge(&sum_c, part_c);
        merge(&sum_d, part_d);
        search.spent += 12u;
        if ends { break; }
    }
    if walks {
        let at = stands(search);
        tree_kept[kept + place] = Kept(sum_a, select(at.x, select(at.y, at.z, place == 2u), place > 0u));
        tree_kept[kept + place + LANES] = Kept(sum_b, 0u);
        tree_kept[kept + place + 2u * LANES] = Kept(sum_c, 0u);
        tree_kept[kept + place + 3u * LANES] = Kept(sum_d, 0u);
        if !search.more {
            if k < last_target() && acts_on(a) { deliver(a, sum_a); }
            if k + LANES < last_target() && acts_on(b) { deliver(b, sum_b); }
            if k + 2u * LANES < last_target() && acts_on(c) { deliver(c, sum_c); }
            if k + 3u * LANES < last_target() && acts_on(d) { deliver(d, sum_d); }
        }
    }
    check_turns(a);
}
