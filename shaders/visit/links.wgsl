// Each particle interacts with those that it is linked to, in the order of its table. The law defines:
// fn gather(me, you, r: vec3f, link: Link, sum: ptr<function, Sum>), with r from me to you, and fn finish(me, sum: Sum) -> vec4f,
// acceleration and potential per unit mass. A link is stored from both of its ends, so nothing is written twice.
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn links(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let me = particle(i);
    var sum = Sum();
    let links = links_of(i);
    for (var k = links.first; k < links.end; k += 1u) {
        let one = link_at(links, k);
        let you = particle(one.partner);
        gather(me, you, refined(shortest(you.position - me.position), me, you), one, &sum);
    }
    // Each of the two holds half of the energy.
    conclude(me, 0.5, sum);
    check_turns(me);
}
