// Particles represented by a surface or a line are not drawn themselves.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(2) var<storage, read_write> projected: array<vec4f>; // pixels right and down, depth of its front, radius
@group(1) @binding(11) var<storage, read> hidden: array<u32>;            // 1 for those

const WORKGROUP: u32 = 64u;
const HIDDEN: f32 = -2.0;

@compute @workgroup_size(WORKGROUP)
fn hide_particles(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        // Their radius stays known, for walls in a plane.
        if hidden[i] == 1u { projected[i].w = HIDDEN - max(projected[i].w, 0.0); }
    }
}
