// What all walks of the tree share: targets walk in groups, so that a group's nodes are looked up once and evaluated by all.
// A law defines: fn gather(me, you, r: vec3f, sum: ptr<function, Sum>), with r from me to you, fn finish(me, sum: Sum) -> vec4f,
// and it may define fn distant(me, you: Group, r: vec3f, sum: ptr<function, Sum>), with r from me to the centre of mass.
//
// Nodes have a heap's numbers: 1 is the root, 2 n and 2 n + 1 are below n, and leaves stand `height` levels below the root.
// A dispatch has the targets first ≤ k < end. With `again` it continues where another one of the same targets had to stop.
struct Tree { unused_word: u32, first: u32, end: u32, height: u32, widened: f32, again: u32 }

@group(2) @binding(0) var<uniform> tree: Tree;
@group(2) @binding(1) var<storage, read> tree_id: array<u32>;
@group(2) @binding(2) var<storage, read> tree_body: array<vec4f>; // xyz, mass
@group(2) @binding(3) var<storage, read> tree_center: array<vec4f>; // of mass, xyz; how near one may come to it
@group(2) @binding(4) var<storage, read> tree_mass: array<vec4f>; // second moments xx, xy, xz about the centre of mass; mass
@group(2) @binding(5) var<storage, read> tree_shape: array<vec4f>; // second moments yy, yz, zz; the longest side of its box

// Particles of a leaf, and of a group.
override LEAF: u32;
override GROUP: u32;

// A far group of particles: its mass, its second moments Σ m y yᵀ about the centre of mass, and half their trace.
struct Group { mass: f32, diagonal: vec3f, mixed: vec3f, half_trace: f32 }

// Its second moments times a vector.
fn moments(group: Group, r: vec3f) -> vec3f {
    return group.diagonal * r + vec3f(group.mixed.x * r.y + group.mixed.y * r.z,
                                      group.mixed.x * r.x + group.mixed.z * r.z,
                                      group.mixed.y * r.x + group.mixed.z * r.y);
}

// A node that is tested: its centre of mass, and its reach, which the opening criterion defines.
struct Node { center: vec3f, reach: Reach }

fn node_at(node: u32) -> Node {
    let center = tree_center[node];
    return Node(center.xyz, reach_of(node, center.w));
}

// Where a group of targets is: the first of them, the middle of their box and half its sides, how far apart its nodes must
// be, and a quarter of the longest side of the box, squared.
struct Place { first: u32, middle: vec3f, half_side: vec3f, demand: f32, wide: f32 }

// Rows that are in use have leaves, and are targets.
fn all_leaves() -> u32 { return (world.count + LEAF - 1u) / LEAF; }
fn last_target() -> u32 { return min(tree.end, world.count); }

// The contents of a node.
fn group_at(node: u32) -> Group {
    let m = tree_mass[node];
    let q = tree_shape[node];
    return Group(m.w, vec3f(m.x, q.x, q.z), vec3f(m.yz, q.y), 0.5 * (m.x + q.x + q.z));
}

fn place_at(group: u32, first: u32, low: vec3f, high: vec3f) -> Place {
    let half_side = 0.5 * (high - low);
    let longest = max(half_side.x, max(half_side.y, half_side.z));
    return Place(first, 0.5 * (low + high), half_side, demand_of(group), 0.25 * longest * longest);
}

// The bounds of a group: the box of its targets, of which `first` exists.
fn place_of(group: u32, first: u32) -> Place {
    var low = tree_body[first].xyz;
    var high = low;
    for (var k = first + 1u; k < min(first + GROUP, world.count); k += 1u) {
        low = min(low, tree_body[k].xyz);
        high = max(high, tree_body[k].xyz);
    }
    return place_at(group, first, low, high);
}

// The leaf at which a group begins.
fn leaf_of(group: u32) -> u32 { return (1u << tree.height) + group * (GROUP / LEAF); }

// A node contains the group that begins at a leaf, or is contained in it.
fn is_own(node: u32, depth: u32, leaf: u32) -> bool {
    let below = tree.height - depth;
    return leaf >> below == node || (node << below) - leaf < GROUP / LEAF;
}

fn squared_size(d: vec3f) -> f32 { return d.x * d.x + d.y * d.y + d.z * d.z; }

// The minimum distance from the group's box to a point, squared.
fn apart(place: Place, x: vec3f) -> f32 {
    return squared_size(max(abs(shortest(x - place.middle)) - place.half_side, vec3f()));
}

// The minimum distance from any of the targets to a point, squared.
fn nearest(place: Place, x: vec3f) -> f32 {
    var least = squared_size(shortest(x - tree_body[place.first].xyz));
    for (var k = place.first + 1u; k < min(place.first + GROUP, world.count); k += 1u) {
        least = min(least, squared_size(shortest(x - tree_body[k].xyz)));
    }
    return least;
}

// A node is opened where it reaches a target. Where it reaches the box of all of them, that is as good as certain, unless
// the box is four times as wide as the node reaches: bodies that follow each other along the curve where few are have a box that may
// hold the core of the whole system, and are nowhere near it. Then they are asked one by one.
fn reaches_box(node: Node, place: Place) -> bool { return reaches(node.reach, apart(place, node.center), place.demand); }
fn is_doubtful(node: Node, place: Place) -> bool { return !reaches(node.reach, place.wide, place.demand); }
fn reaches_target(node: Node, place: Place) -> bool { return reaches(node.reach, nearest(place, node.center), place.demand); }

fn reaches_any(node: u32, place: Place) -> bool {
    let tested = node_at(node);
    return reaches_box(tested, place) && (!is_doubtful(tested, place) || reaches_target(tested, place));
}

fn target_of(slot: u32) -> Particle {
    let p = tree_body[slot];
    return Particle(tree_id[slot], p.xyz, p.w);
}

// A node is on the level of `depth`, and contains particles.
fn exists(node: u32, depth: u32) -> bool {
    return ((node - (1u << depth)) << (tree.height - depth)) < all_leaves();
}

fn deliver(me: Particle, sum: Sum) {
    // Each of a pair holds half of its potential energy.
    conclude(me, 0.5, sum);
}
