// The box grows by the change ε of the logarithm of its volume, each side by the part c = exp(ε / d) − 1: its highest corner moves, and the
// lowest one stays. All kernels have the box from `world`.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read_write> box_corner: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> box_strain: array<f32>;
@group(1) @binding(2) var<storage, read_write> box_change: array<f32>; // c
@group(1) @binding(3) var<storage, read_write> box_watch: array<vec4f>;
@group(2) @binding(0) var<storage, read_write> box_go: array<u32>;

// Whether there is a change to make: there is none where a run begins.
override APPLY: bool = true;
// The workgroups that move particles.
override GROUPS: u32 = 1u;
override ROWS: u32 = 1u;

// exp(x) − 1: up to 0.15 it is right to 1e-9.
fn grown(x: f32) -> f32 { return x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0))))); }

@compute @workgroup_size(1)
fn box_advance() {
    let is_periodic = world.period > vec3f();
    var corner = box_corner[0].xyz;
    if APPLY {
        let change = grown(box_strain[0] / f32(world.dimensions));
        corner = select(corner, corner + (corner - world.low) * change, is_periodic);
        box_corner[0] = vec4f(corner, 0.0);
        box_change[0] = change;
        box_strain[0] = 0.0;
        let side = corner.x - world.low.x;
        let shortest = box_watch[0].x;
        box_watch[0].x = select(min(shortest, side), side, shortest == 0.0);
        let moves = change != 0.0;
        box_go[0] = select(0u, GROUPS, moves);
        box_go[1] = select(0u, ROWS, moves);
        box_go[2] = select(0u, 1u, moves);
    }
    let side = select(vec3f(1.0), corner - world.low, is_periodic);
    world.high = select(world.high, corner, is_periodic);
    world.period = select(vec3f(), side, is_periodic);
    world.frequency = select(vec3f(), 1.0 / side, is_periodic);
}
