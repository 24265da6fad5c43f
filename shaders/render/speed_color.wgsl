// Colours by speed, from blue through pale to gold, lighter with speed: linear interpolation between five colours.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;        // xyz, radius
@group(1) @binding(1) var<storage, read_write> color: array<u32>;       // red, green, blue from the lowest byte on

const WORKGROUP: u32 = 64u;

fn map(part: f32) -> vec3f {
    let t = 4.0 * part;
    var c = mix(vec3f(0.26, 0.28, 0.84), vec3f(0.29, 0.54, 0.96), clamp(t, 0.0, 1.0));
    c = mix(c, vec3f(0.52, 0.79, 0.94), clamp(t - 1.0, 0.0, 1.0));
    c = mix(c, vec3f(0.96, 0.90, 0.74), clamp(t - 2.0, 0.0, 1.0));
    let last = clamp(t - 3.0, 0.0, 1.0);
    return mix(c, vec3f(1.0, 0.77, 0.38), last);
}

@compute @workgroup_size(WORKGROUP)
fn speed_color(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let part = clamp((length(velocity[i].xyz) - frame.slow) / (frame.fast - frame.slow), 0.0, 1.0);
        color[i] = pack4x8unorm(vec4f(map(part), 1.0));
    }
}
