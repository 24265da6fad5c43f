// What a group of targets asks for where the opening is relative: G / (α a) with the least a that any of them felt last.
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(2) @binding(0) var<storage, read> tree_id: array<u32>;
@group(2) @binding(1) var<storage, read_write> tree_demand: array<f32>;

override GROUP: u32;
// G / α
override STRICTNESS: f32;
const WORKGROUP: u32 = 64u;
const ENDLESS: f32 = 3.4e38;

// The size of a vector whose square may be too small to be held.
fn size(a: vec3f) -> f32 {
    let most = max(abs(a.x), max(abs(a.y), abs(a.z)));
    return select(0.0, most * length(a / most), most > 0.0);
}

@compute @workgroup_size(WORKGROUP)
fn demand(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let g = folded(group, groups) * WORKGROUP + lane;
    let first = g * GROUP;
    if first < world.count {
        var least = ENDLESS;
        for (var k = first; k < min(first + GROUP, world.count); k++) { least = min(least, size(acceleration[tree_id[k]].xyz)); }
        tree_demand[g] = select(0.0, STRICTNESS / least, least > 0.0);
    }
}
