// Rigid rods in open chains (RATTLE: Andersen 1983). After a drift by h the lengths are restored by v ← v + δ and x ← x + h δ,
// with δ along the rods before the drift; then the rounding errors of the lengths are removed from x alone; then, as after a
// kick, r · v = 0 is restored by v ← v + δ along the rods after it. Newton's method, with a tridiagonal system for the forces in
// the rods in each iteration (Thomas 1949). One invocation for each chain.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(3) @binding(0) var<storage, read> chain_start: array<u32>; // the first node of each chain, and the number of nodes
@group(3) @binding(1) var<storage, read> chain_node: array<Node>;
@group(3) @binding(2) var<storage, read_write> chain_sweep: array<vec2f>; // for each rod, at its last node: x and y below

// A particle in a chain, and the length of the rod that leads to it; fixed particles do not move.
struct Node { id: u32, held: u32, length: f32 }
// A particle: where, how fast, and one over its mass.
struct Bob { x: vec3f, v: vec3f, w: f32 }
// The rod between two: its way now, its way before the drift, and by how much it misses what it must be.
struct Rod { r: vec3f, old: vec3f, miss: f32 }

// The part of the step that was drifted; 0 after a kick.
override FACTOR: f32 = 0.0;
override CHAINS: u32 = 0u;
// Whether it was no drift: x − h v is not where it began, and so has not the right lengths.
override SETTLES: bool = false;
// Each doubles the digits; the host bounds the rods of a chain by them.
const TURNS: u32 = 6u;
const STRETCHES: u32 = 4u;
// Parts of its length by which a rod may miss: so few that rounding decides; and so many that it is not on the way to be right.
const CLOSE: f32 = 3e-7;
const FAR: f32 = 1e-3;

fn bob(n: u32) -> Bob {
    let node = chain_node[n];
    let x = position[node.id];
    return Bob(x.xyz, velocity[node.id].xyz, select(1.0 / x.w, 0.0, node.held > 0u));
}

// No length changes where v is at right angles to r + old. Half the difference of two squares would be rounding, in which
// speeds would share: they would grow.
fn rod(a: Bob, b: Bob, length: f32, h: f32, stretch: bool) -> Rod {
    let way = b.x - a.x;
    let r = way - world.period * round(way * world.frequency);
    let v = b.v - a.v;
    let old = r - h * v;
    let grown = 0.5 * (length * length - dot(old, old)) / h;
    let turn = select(0.0, grown, SETTLES && h != 0.0) - 0.5 * dot(v, r + old);
    return Rod(r, old, select(turn, 0.5 * (length * length - dot(r, r)), stretch));
}

fn push(n: u32, change: vec3f, h: f32, stretch: bool) {
    let node = chain_node[n];
    if node.held == 0u {
        position[node.id] += vec4f(select(h, 1.0, stretch) * change, 0.0);
        velocity[node.id] += vec4f(select(1.0, 0.0, stretch) * change, 0.0);
    }
}

// Newton's step for the multipliers y of the rods: y[n] + x[n + 1] y[n + 1] is known from all before. Gives the largest miss,
// as a part of the length.
fn correct(first: u32, last: u32, h: f32, stretch: bool) -> f32 {
    var a = bob(first);
    var before = Rod();
    var pivot = 1.0;
    var known = 0.0;
    var worst = 0.0;
    for (var n = first + 1u; n <= last; n += 1u) {
        let b = bob(n);
        let length = chain_node[n].length;
        let now = rod(a, b, length, h, stretch);
        let upper = -a.w * dot(before.r, now.old) / pivot;
        let lower = -a.w * dot(now.r, before.old);
        pivot = (a.w + b.w) * dot(now.r, now.old) - lower * upper;
        known = (now.miss - lower * known) / pivot;
        chain_sweep[n] = vec2f(upper, known);
        let square = length * length;
        worst = max(worst, abs(select(h, 1.0, stretch) * now.miss) / square);
        a = b;
        before = now;
    }
    var multiplier = 0.0;
    var upper = 0.0;
    var behind = vec3f();
    for (var n = last; n > first; n -= 1u) {
        let b = a;
        a = bob(n - 1u);
        let sweep = chain_sweep[n];
        multiplier = sweep.y - upper * multiplier;
        upper = sweep.x;
        let along = multiplier * rod(a, b, chain_node[n].length, h, stretch).old;
        push(n, b.w * (along - behind), h, stretch);
        behind = along;
    }
    push(first, -a.w * behind, h, stretch);
    return worst;
}

// Whole vectors of any processor. In a part of one, lanes that are not there spend the trips of those that are.
@compute @workgroup_size(64)
fn rods(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * 64u + lane;
    if i < CHAINS {
        let first = chain_start[i];
        let last = chain_start[i + 1u] - 1u;
        let h = FACTOR * world.dt;
        if h != 0.0 {
            var turn = FAR;
            for (var n = 0u; n < TURNS && turn > CLOSE; n += 1u) { turn = correct(first, last, h, false); }
            var stretch = FAR;
            for (var n = 0u; n < STRETCHES && stretch > CLOSE; n += 1u) { stretch = correct(first, last, 0.0, true); }
            // A chain that does not come right is a chain no more, and the watch is to see it. One of these two is not held.
            if max(turn, stretch) > FAR {
                var nan = 0x7fc00000u;
                push(first, vec3f(bitcast<f32>(nan)), h, true);
                push(first + 1u, vec3f(bitcast<f32>(nan)), h, true);
            }
        }
        // Once more than exact numbers want it, for the digits that a long chain loses.
        correct(first, last, 0.0, false);
        correct(first, last, 0.0, false);
    }
}
