// The result of the divergence solve: its accelerations are added to all others. With their sum
// the density at the end of the step is predicted.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(3) @binding(4) var<storage, read> unknowns: array<Unknown>;
@group(3) @binding(5) var<storage, read_write> pushes: array<vec4f>;
@group(3) @binding(7) var<storage, read_write> dfsph_state: array<State>;
@group(3) @binding(8) var<storage, read_write> stiffness: array<Stiffness>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn collect(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k >= world.count { return; }
    if k == 0u { dfsph_state[1] = State(); }
    let id = sorted_id[k];
    // Walls have prescribed motions.
    if unknowns[k].stiffness >= 0.0 {
        stiffness[id].divergence = unknowns[k].stiffness;
        acceleration[id] += vec4f(pushes[k].xyz, 0.0);
        pushes[k] = vec4f(acceleration[id].xyz, 1.0);
    }
}
