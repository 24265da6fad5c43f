// The bounding cube of the keys: the lowest corner of all positions, and cells per length along its side, 2²¹ of them along
// the longest side of their box.
@group(2) @binding(0) var<storage, read> tree_least: array<vec4f>;
@group(2) @binding(1) var<storage, read> tree_greatest: array<vec4f>;
@group(2) @binding(2) var<storage, read_write> tree_cube: array<vec4f>; // corner, cells per length

// A cell of a cube less wide than 2²¹ of the least normal numbers is none; nor is one of a cube without an end. All
// particles are in one cell then, and stay in the order of their ids.
const LEAST: f32 = 2.5e-32;
const GREATEST: f32 = 3.4e38;

@compute @workgroup_size(1)
fn cube() {
    let low = tree_least[0].xyz;
    let sides = tree_greatest[0].xyz - low;
    let side = max(sides.x, max(sides.y, sides.z));
    var scale = 0.0;
    if side > LEAST && side < GREATEST { scale = f32(CELLS) / side; }
    tree_cube[0] = vec4f(low, scale);
}
