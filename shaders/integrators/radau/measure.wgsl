// The largest components: of the change of the last difference by an iteration, of the acceleration, and of the last difference.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(1) var<storage, read_write> radau_sizes: array<vec4f>;

const WORKGROUP: u32 = 64u;

fn largest(v: vec3f) -> f32 { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

@compute @workgroup_size(WORKGROUP)
fn radau_measure(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let g = acceleration_differences[i * DIFFERENCES + DIFFERENCES - 1u].xyz;
    let before = step_start[i * SLOTS + BEFORE].xyz;
    radau_sizes[i] = vec4f(largest(g - before), largest(acceleration[i].xyz), largest(g), 0.0);
}
