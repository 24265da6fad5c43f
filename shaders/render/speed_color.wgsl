// Colours by speed, on the scale of values.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;        // xyz, radius
@group(1) @binding(1) var<storage, read_write> color: array<u32>;       // red, green, blue from the lowest byte on

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn speed_color(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let part = clamp((length(velocity[i].xyz) - frame.slow) / (frame.fast - frame.slow), 0.0, 1.0);
        color[i] = pack4x8unorm(vec4f(map(part), 1.0));
    }
}
