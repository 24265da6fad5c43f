// Raises the alarm when a number is not finite: records the first step in which that is seen, and the lowest id
// there; and at a runaway: a speed is more than twice the maximum of the 16 steps before, for the eighth time in a row.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;
// 0 steps done, 1 id; 3 and 4 the same for speeds; 5 the largest speed of these 16 steps, 6 of those before, 7 how often doubled
@group(1) @binding(3) var<storage, read_write> alarm: array<atomic<u32>>;

// Steps that are done once this kernel has run, beyond those that are counted: it may run before they are.
override AHEAD: u32 = 0u;
const WORKGROUP: u32 = 64u;
const LARGEST: f32 = 3.4028234663852886e38;

fn done() -> u32 { return world.step + AHEAD; }

// The speed beyond which a particle runs away.
fn bar() -> f32 {
    if atomicLoad(&alarm[7]) >= 7u { return 2.0 * bitcast<f32>(atomicLoad(&alarm[6])); }
    return LARGEST;
}

// The bits of a particle's speed, which are in the floats' order; 0 if it is not finite.
fn examined(i: u32, bar: f32) -> u32 {
    if broken(position[i]) || broken(velocity[i]) || broken(acceleration[i]) {
        // Later checks find an earlier step already stored, and do not change the id.
        if atomicMin(&alarm[0], done()) >= done() { atomicMin(&alarm[1], i); }
        return 0u;
    }
    // The largest component stands for the speed: it has no rounding.
    let v = abs(velocity[i].xyz);
    let speed = max(max(v.x, v.y), v.z);
    if speed > bar {
        if atomicMin(&alarm[3], done()) >= done() { atomicMin(&alarm[4], i); }
    }
    return bitcast<u32>(speed);
}

// Few are faster than all before them: most only compare.
fn note(speed: u32) {
    if speed > atomicLoad(&alarm[5]) { atomicMax(&alarm[5], speed); }
}
