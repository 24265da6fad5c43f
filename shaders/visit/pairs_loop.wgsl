// All pairs, for software adapters: no barrier, no shared memory, sources straight from the array.
const WORKGROUP: u32 = 64u;
const TARGETS: u32 = 4u;
const BLOCK: u32 = 128u;

fn source(k: u32) -> Particle {
    return particle_of(k, position[k], low_words_of(k));
}

@compute @workgroup_size(WORKGROUP)
fn pairs(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let mine = folded(group, groups) * (WORKGROUP * TARGETS);
    let i = mine + lane;
    let a = target_at(i);
    let b = target_at(i + WORKGROUP);
    let c = target_at(i + 2u * WORKGROUP);
    let d = target_at(i + 3u * WORKGROUP);
    var total_a = resume(group.z, i);
    var total_b = resume(group.z, i + WORKGROUP);
    var total_c = resume(group.z, i + 2u * WORKGROUP);
    var total_d = resume(group.z, i + 3u * WORKGROUP);

    let first = span.first + group.z * span.slice;
    let end = min(min(first + span.slice, span.end), sources_of(mine));
    for (var start = first; start < end; start += BLOCK) {
        var sum_a = Sum();
        var sum_b = Sum();
        var sum_c = Sum();
        var sum_d = Sum();
        let apart = is_apart(start, BLOCK, mine, WORKGROUP * TARGETS);
        if apart && start + BLOCK <= end {
            for (var k = start; k < start + BLOCK; k += 8u) {
                meet(source(k), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 1u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 2u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 3u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 4u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 5u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 6u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
                meet(source(k + 7u), a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
            }
        } else {
            for (var k = start; k < min(start + BLOCK, end); k += 1u) {
                let you = source(k);
                meet_others(you, a, b, c, d, &sum_a, &sum_b, &sum_c, &sum_d);
            }
        }
        merge(&total_a, sum_a);
        merge(&total_b, sum_b);
        merge(&total_c, sum_c);
        merge(&total_d, sum_d);
    }
    deliver(group.z, i, total_a);
    deliver(group.z, i + WORKGROUP, total_b);
    deliver(group.z, i + 2u * WORKGROUP, total_c);
    deliver(group.z, i + 3u * WORKGROUP, total_d);
    check_turns(a);
}
