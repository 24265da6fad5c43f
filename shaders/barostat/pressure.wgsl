// What barostats share: the pressure P = Σ (m v² − r · F) / d V at the end of every so many steps, and the change ε of the logarithm of the
// volume that follows from it, which the box makes in the next step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> pressure_total: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> box_strain: array<f32>;
// The shortest side so far, the largest |ε|, how many particles had forces that did not add up, and the longest side so far.
@group(1) @binding(2) var<storage, read_write> box_watch: array<vec4f>;

override EVERY: u32 = 1u;

fn due() -> bool { return (world.step + 1u) % EVERY == 0u; }

// The time from one change to the next.
fn span() -> f32 { return f32(EVERY) * world.dt; }

// The area in the plane.
fn volume() -> f32 { return world.period.x * world.period.y * select(1.0, world.period.z, world.dimensions == 3u); }

fn pressure() -> f32 { return (pressure_total[0].x + pressure_total[0].y) / (f32(world.dimensions) * volume()); }

fn strain(by: f32) {
    box_strain[0] = by;
    box_watch[0].y = max(box_watch[0].y, abs(by));
    box_watch[0].z += pressure_total[0].z;
}
