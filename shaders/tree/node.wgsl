// A node: its mass M, its centre of mass c, its second moments Σ m y yᵀ with y = x - c (first xx, xy and xz, then
// yy, yz and zz, so that each vector has the magnitude of its cancelling terms), and its tight bounding box. Two are
// combined by the parallel axis theorem, so that nothing is the difference of large sums:
// Σ m y yᵀ = those of both + m₁ m₂ / M d dᵀ, with d from one centre to the other.
struct Node { mass: f32, center: vec3f, first: vec3f, second: vec3f, low: vec3f, high: vec3f }
// The nodes of one level: where they begin, and how many levels above the leaves that is.
struct Level { unused_word: u32, first: u32, above: u32 }

@group(2) @binding(0) var<uniform> level: Level;
@group(2) @binding(1) var<storage, read_write> tree_center: array<vec4f>; // center, reach
@group(2) @binding(2) var<storage, read_write> tree_mass: array<vec4f>;   // xx, xy, xz, mass
@group(2) @binding(3) var<storage, read_write> tree_shape: array<vec4f>;  // yy, yz, zz, longest side
@group(2) @binding(4) var<storage, read_write> tree_low: array<vec4f>;    // xyz
@group(2) @binding(5) var<storage, read_write> tree_high: array<vec4f>;   // xyz

const HALF_DIAGONAL: f32 = 0.8660254; // √3 / 2

// A node of side l reaches OPENING l from its centre, at least.
override OPENING: f32;
override CORE: f32;

fn together(a: Node, b: Node) -> Node {
    let mass = a.mass + b.mass;
    // Of two that weigh nothing neither moves the other.
    var part = 0.0;
    if mass != 0.0 { part = b.mass / mass; }
    let d = b.center - a.center;
    let weight = a.mass * part;
    return Node(
        mass,
        a.center + part * d,
        a.first + b.first + (weight * d.x) * d,
        a.second + b.second + (weight * d.yyz) * d.yzz,
        min(a.low, b.low),
        max(a.high, b.high),
    );
}

fn known(n: u32) -> Node {
    let center = tree_center[n];
    let mass = tree_mass[n];
    return Node(mass.w, center.xyz, mass.xyz, tree_shape[n].xyz, tree_low[n].xyz, tree_high[n].xyz);
}

fn keep(n: u32, node: Node) {
    let sides = node.high - node.low;
    let middle = node.low + 0.5 * sides;
    let center = select(middle, node.center, node.mass != 0.0);
    let side = max(sides.x, max(sides.y, sides.z));
    let reach = max(OPENING * side, CORE + HALF_DIAGONAL * side) + distance(center, middle);
    tree_center[n] = vec4f(center, reach);
    tree_mass[n] = vec4f(node.first, node.mass);
    tree_shape[n] = vec4f(node.second, side);
    tree_low[n] = vec4f(node.low, 0.0);
    tree_high[n] = vec4f(node.high, 0.0);
}
