// Colours by a column, on the scale of values; grey where it is not finite. What the column holds is given by `value` of another file.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(1) var<storage, read_write> color: array<u32>;       // red, green, blue from the lowest byte on

const WORKGROUP: u32 = 64u;
// Whether the ends of the scale are logarithms of values; below the smallest positive one all are the same.
override LOGARITHMIC: u32;
const SMALLEST: f32 = 1e-37;

@compute @workgroup_size(WORKGROUP)
fn column_color(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = value(i);
        let y = select(x, log(max(x, SMALLEST)), LOGARITHMIC == 1u);
        let part = clamp((y - frame.slow) / (frame.fast - frame.slow), 0.0, 1.0);
        color[i] = pack4x8unorm(vec4f(select(map(part), vec3f(0.5), broken(vec4f(x))), 1.0));
    }
}
