// Foam: how white a particle is, from 0 at ⅗ of a speed to 1 at that speed. It is the fourth byte of the colour.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;  // xyz, radius
@group(1) @binding(3) var<storage, read_write> color: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn foam(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        var white = 0.0;
        if !broken(v) { white = clamp(2.5 * length(v.xyz) / frame.foam - 1.5, 0.0, 1.0); }
        color[i] = (color[i] & 0xffffffu) | (u32(255.0 * white + 0.5) << 24u);
    }
}
