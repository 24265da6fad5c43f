// A spring breaks beyond the strain s:  l > (1 + s) L.  Both ends evaluate the same two positions, and decide alike.
// A broken spring has neither stiffness nor damping; a spring of rest length 0 does not break.
struct Link { partner: u32, rest: f32, stiffness: f32, damping: f32 }

@group(2) @binding(0) var<storage, read> link_start: array<u32>; // one for each particle, and the end
@group(2) @binding(1) var<storage, read_write> link: array<Link>;

override STRAIN: f32 = 0.1;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn tear(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let me = particle(i);
    let end = link_start[i + 1u];
    for (var k = link_start[i]; k < end; k += 1u) {
        let r = shortest(particle(link[k].partner).position - me.position);
        let longest = (1.0 + STRAIN) * abs(link[k].rest);
        let beyond = dot(r, r) > longest * longest;
        if longest > 0.0 && beyond {
            link[k].stiffness = 0.0;
            link[k].damping = 0.0;
        }
    }
}
