// The position after a part of the step, from its start: x ← x₀ + c v dt.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> start_position: array<vec4f>;

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn reach(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { position[i] = start_position[i] + vec4f((FACTOR * world.dt) * velocity[i].xyz, 0.0); }
}
