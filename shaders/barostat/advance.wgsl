// The box grows by the change ε of the logarithm of its volume, each side by the part c = exp(ε / d) − 1: its highest corner moves, and the
// lowest one stays. What single precision rounds from the corner is kept (integrators/two_sum.wgsl), and changes that positions do not resolve
// wait there until they do. All kernels have the box from `world`.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read_write> box_corner: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> box_corner_low: array<vec4f>; // what is still to be added to it
@group(1) @binding(2) var<storage, read_write> box_strain: array<f32>;       // ε
@group(1) @binding(3) var<storage, read_write> box_change: array<vec4f>;     // the change made, as a part of each side
@group(1) @binding(4) var<storage, read_write> box_watch: array<vec4f>;
@group(2) @binding(0) var<storage, read_write> box_go: array<u32>;

// Whether there is a change to make: there is none where a run begins.
override APPLY: bool = true;
// The workgroups that move particles.
override GROUPS: u32 = 1u;
override ROWS: u32 = 1u;
// 64 units in the last place of a coordinate: of such a step of the far side, the particles beside it round a hundredth.
const RESOLVED: f32 = 7.62939453125e-6; // 2⁻¹⁷

// exp(x) − 1: up to 0.15 it is right to 1e-9.
fn grown(x: f32) -> f32 { return x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0))))); }

@compute @workgroup_size(1)
fn box_advance() {
    let is_periodic = world.period > vec3f();
    var corner = box_corner[0].xyz;
    if APPLY {
        let side = select(vec3f(1.0), corner - world.low, is_periodic);
        let way = side * grown(box_strain[0] / f32(world.dimensions)) + box_corner_low[0].xyz;
        let due = select(vec3f(), way, is_periodic);
        let moves = any((abs(due) >= RESOLVED * max(abs(corner), abs(world.low))) & is_periodic);
        var next = Words(corner, due);
        if moves { next = two_sum(corner, due); }
        box_change[0] = vec4f((next.high - corner) / side, 0.0);
        corner = next.high;
        box_corner[0] = vec4f(corner, 0.0);
        box_corner_low[0] = vec4f(next.low, 0.0);
        box_strain[0] = 0.0;
        let shortest = box_watch[0].x;
        let along = corner.x - world.low.x;
        box_watch[0].x = select(min(shortest, along), along, shortest == 0.0);
        box_watch[0].w = max(box_watch[0].w, along);
        box_go[0] = select(0u, GROUPS, moves);
        box_go[1] = select(0u, ROWS, moves);
        box_go[2] = select(0u, 1u, moves);
    }
    let side = select(vec3f(1.0), corner - world.low, is_periodic);
    world.high = select(world.high, corner, is_periodic);
    world.period = select(vec3f(), side, is_periodic);
    world.frequency = select(vec3f(), 1.0 / side, is_periodic);
}
