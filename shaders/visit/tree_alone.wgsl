// Targets walk the tree side by side, for processors that play a GPU: a lane for each, no barrier, no memory of where it has
// been. Below a node its left child comes next; then the next node of its level, or of the level of the first above it that
// has one. All of a group open the same nodes. A turn has one node, or one body of a leaf: an adapter that runs lanes as
// vectors takes every way of every branch, so there are few.
const WORKGROUP: u32 = 32u;

@compute @workgroup_size(WORKGROUP)
fn walk(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let mine = tree.first / GROUP + folded(group, groups);
    let k = mine * GROUP + lane;
    if k < last_target() {
        let me = target_of(k);
        let here = place_of(mine, mine * GROUP);
        let own = leaf_of(mine);
        let kept = k - tree.first;
        var near = Sum();
        var far = Sum();
        var node = 1u;
        if tree.again > 0u {
            near = tree_kept[kept].sum;
            node = tree_kept[kept].at;
        }
        let walks = node > 0u;
        var depth = firstLeadingBit(node);
        var slot = 0u;
        var bodies = 0u;
        var more = walks;
        var spent = GROUP;
        while bodies > 0u || more && spent <= MOST {
            if bodies > 0u {
                if slot != k && slot < world.count {
                    let you = target_of(slot);
                    gather(me, you, shortest(you.position - me.position), &near);
                }
                slot += 1u;
                bodies -= 1u;
            } else {
                let real = exists(node, depth);
                let itself = real && is_own(node, depth, own);
                var open = itself || real && reaches_box(node, here);
                if open && !itself && is_doubtful(node, here) {
                    open = reaches_target(node, here);
                    spent += GROUP;
                }
                if real && !open { distant(me, group_at(node), shortest(tree_center[node].xyz - me.position), &far); }
                if open && depth < tree.height {
                    node = 2u * node;
                    depth += 1u;
                } else {
                    slot = (node - (1u << tree.height)) * LEAF;
                    bodies = select(0u, LEAF, open);
                    // Behind the last of all levels stands a power of two.
                    let up = countTrailingZeros(node + 1u);
                    node = (node + 1u) >> up;
                    depth -= up;
                    more = node > 1u;
                }
            }
            // A loop that has nothing to do takes a turn to see that.
            spent += 2u;
        }
        merge(&near, far);
        tree_kept[kept] = Kept(near, select(0u, node, more));
        if walks && !more && acts_on(me) { deliver(me, near); }
        check_turns(me);
    }
}
