// Each particle interacts with those that it is linked to, where there are up to four kinds of links: those of one kind follow each
// other, by the ids of the partners, and a link is no more than its partner. A law defines the same functions as in shaders/visit/links.wgsl.
struct Link { partner: u32, rest: f32, stiffness: f32, damping: f32 }

@group(2) @binding(0) var<storage, read> partner_start: array<vec4u>; // of each kind, for each particle, and the end
@group(2) @binding(1) var<storage, read> partner: array<u32>;
@group(2) @binding(2) var<storage, read> link_kind: array<Link>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn links_alike(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let me = particle(i);
    var sum = Sum();
    let start = partner_start[i];
    let end = partner_start[i + 1u].x;
    let a = link_kind[0];
    let b = link_kind[1];
    let c = link_kind[2];
    let d = link_kind[3];
    // One loop over all kinds: to choose among four costs less than to begin four times.
    for (var k = start.x; k < end; k += 1u) {
        var one = a;
        if k >= start.y { one = b; }
        if k >= start.z { one = c; }
        if k >= start.w { one = d; }
        one.partner = partner[k];
        let you = particle(one.partner);
        gather(me, you, refined(shortest(you.position - me.position), me, you), one, &sum);
    }
    // Each of the two holds half of the energy.
    conclude(me, 0.5, sum);
    check_turns(me);
}
