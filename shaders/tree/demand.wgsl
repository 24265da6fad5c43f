// The relative opening criterion of a group of targets: G / (α a) with the smallest last acceleration a in the group, or
// with 1/32 of the sum of the magnitudes of all attractions on the group, if that is larger: where they cancel, the force
// is no scale for errors, and the group would open all nodes.
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(2) @binding(0) var<storage, read> tree_id: array<u32>;
@group(2) @binding(1) var<storage, read_write> tree_demand: array<f32>;
@group(2) @binding(2) var<storage, read> tree_body: array<vec4f>; // xyz, mass
@group(2) @binding(3) var<storage, read> tree_center: array<vec4f>; // of mass, xyz
@group(2) @binding(4) var<storage, read> tree_mass: array<vec4f>; // w: mass
@group(2) @binding(5) var<storage, read> tree_shape: array<vec4f>; // w: longest side

override GROUP: u32;
// The nodes whose pulls are added: of one level, the first, and how many levels above the leaves that is.
override FIRST: u32;
override ABOVE: u32;
// G / α, and the part of G M / (r² + l²) that counts as a force.
override STRICTNESS: f32;
override PART: f32;
const WORKGROUP: u32 = 64u;
const ENDLESS: f32 = 3.4e38;

// The size of a vector whose square may be too small to be held.
fn size(a: vec3f) -> f32 {
    let most = max(abs(a.x), max(abs(a.y), abs(a.z)));
    return select(0.0, most * length(a / most), most > 0.0);
}

// A part of what the sizes of all pulls at a place add up to, about.
fn pulls(x: vec3f) -> f32 {
    var sum = 0.0;
    for (var n = FIRST; n < FIRST + nodes_of(ABOVE); n++) {
        let r = shortest(tree_center[n].xyz - x);
        let side = tree_shape[n].w;
        let square = dot(r, r) + side * side;
        if square > 0.0 { sum += abs(tree_mass[n].w) / square; }
    }
    return PART * sum;
}

@compute @workgroup_size(WORKGROUP)
fn demand(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let g = folded(group, groups) * WORKGROUP + lane;
    let first = g * GROUP;
    if first < world.count {
        var least = ENDLESS;
        for (var k = first; k < min(first + GROUP, world.count); k++) { least = min(least, size(acceleration[tree_id[k]].xyz)); }
        tree_demand[g] = select(0.0, STRICTNESS / max(least, pulls(tree_body[first].xyz)), least > 0.0);
    }
}
