// The result of the density solve. Pressure is that of both solves.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(3) @binding(4) var<storage, read> unknowns: array<Unknown>;
@group(3) @binding(5) var<storage, read> pushes: array<vec4f>;
@group(3) @binding(8) var<storage, read_write> stiffness: array<Stiffness>;
@group(3) @binding(12) var<storage, read_write> pressure: array<f32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn finish(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k >= world.count { return; }
    let id = sorted_id[k];
    let mine = unknowns[k].stiffness;
    if mine >= 0.0 {
        stiffness[id].density = mine;
        pressure[id] = REST_DENSITY * (stiffness[id].divergence + mine);
        acceleration[id] += vec4f(pushes[k].xyz, 0.0);
    }
}
