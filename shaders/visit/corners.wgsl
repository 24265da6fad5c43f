// Each particle visits the joints, the dihedrals or the triangles of which it is a corner, in the order of their ids. The law defines:
// fn gather(me, corner: Corner, sum: ptr<function, Sum>), and fn finish(me, sum: Sum) -> vec4f, acceleration and potential per unit mass.
// An element is stored with each of its corners, so nothing is written twice.
@group(2) @binding(0) var<storage, read> corner_start: array<u32>; // one for each particle, and the end
@group(2) @binding(1) var<storage, read> corner: array<Corner>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn corners(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let me = particle(i);
    var sum = Sum();
    let end = corner_start[i + 1u];
    for (var k = corner_start[i]; k < end; k += 1u) { gather(me, corner[k], &sum); }
    // Each corner has the same part of the energy.
    conclude(me, 1.0 / CORNERS, sum);
    check_turns(me);
}
