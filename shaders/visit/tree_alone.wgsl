// Groups of targets walk the tree, for software adapters without subgroups: a vector of eight lanes for each, four
// targets a lane, no barrier, no memory of where it has been. Below a node its left child comes next; then the next node of
// its level, or of the level of the first above it that has one. All lanes of a group open the same nodes. A turn has one node,
// or one body of a leaf: an adapter that runs lanes as vectors takes every way of every branch, so there are few.
const WORKGROUP: u32 = 8u;

// A body that is there, and not the target itself: a law of a user may have a loop that does not end at no distance.
fn meet_body(slot: u32, mine: u32, me: Particle, you: Particle, sum: ptr<function, Sum>) {
    if slot != mine && slot < world.count { gather(me, you, shortest(you.position - me.position), sum); }
}

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let first = mine * GROUP;
    if first < last_target() && is_wanted(mine) {
        let last = world.count - 1u;
        let k = first + lane;
        let a = target_of(min(k, last));
        let b = target_of(min(k + LANES, last));
        let c = target_of(min(k + 2u * LANES, last));
        let d = target_of(min(k + 3u * LANES, last));
        let here = place_of(mine, first);
        let own = leaf_of(mine);
        let kept = k - tree.first;
        var near_a = Sum();
        var near_b = Sum();
        var near_c = Sum();
        var near_d = Sum();
        var far_a = Sum();
        var far_b = Sum();
        var far_c = Sum();
        var far_d = Sum();
        var node = 1u;
        if tree.again > 0u {
            near_a = tree_kept[kept].sum;
            near_b = tree_kept[kept + LANES].sum;
            near_c = tree_kept[kept + 2u * LANES].sum;
            near_d = tree_kept[kept + 3u * LANES].sum;
            node = tree_kept[kept].at;
        }
        let walks = node > 0u;
        var depth = firstLeadingBit(node);
        var slot = 0u;
        var bodies = 0u;
        var more = walks;
        var spent = GROUP;
        while bodies > 0u || (more && spent <= MOST) {
            if bodies > 0u {
                let you = target_of(min(slot, last));
                meet_body(slot, k, a, you, &near_a);
                meet_body(slot, k + LANES, b, you, &near_b);
                meet_body(slot, k + 2u * LANES, c, you, &near_c);
                meet_body(slot, k + 3u * LANES, d, you, &near_d);
                slot += 1u;
                bodies -= 1u;
            } else {
                let real = exists(node, depth);
                let itself = real && is_own(node, depth, own);
                var open = itself;
                if real && !itself {
                    let tested = node_at(node);
                    open = reaches_box(tested, here);
                    if open && is_doubtful(tested, here) {
                        open = reaches_target(tested, here);
                        spent += GROUP;
                    }
                }
                if real && !open {
                    meet_group(tree_center[node].xyz, group_at(node), a, b, c, d, &far_a, &far_b, &far_c, &far_d);
                }
                if open && depth < tree.height {
                    node = 2u * node;
                    depth += 1u;
                } else {
                    slot = (node - (1u << tree.height)) * LEAF;
                    bodies = select(0u, LEAF, open);
                    // After the last of all levels comes a power of two.
                    let up = countTrailingZeros(node + 1u);
                    node = (node + 1u) >> up;
                    depth -= up;
                    more = node > 1u;
                }
            }
            // A loop with nothing to do takes an iteration to detect that.
            spent += 2u;
        }
        merge(&near_a, far_a);
        merge(&near_b, far_b);
        merge(&near_c, far_c);
        merge(&near_d, far_d);
        let at = select(0u, node, more);
        tree_kept[kept] = Kept(near_a, at);
        tree_kept[kept + LANES] = Kept(near_b, at);
        tree_kept[kept + 2u * LANES] = Kept(near_c, at);
        tree_kept[kept + 3u * LANES] = Kept(near_d, at);
        if walks && !more {
            if k < last_target() && acts_on(a) { deliver(a, near_a); }
            if k + LANES < last_target() && acts_on(b) { deliver(b, near_b); }
            if k + 2u * LANES < last_target() && acts_on(c) { deliver(c, near_c); }
            if k + 3u * LANES < last_target() && acts_on(d) { deliver(d, near_d); }
        }
        check_turns(a);
    }
}
