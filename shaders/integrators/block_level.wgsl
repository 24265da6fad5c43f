// Particles whose own step ends choose the next one, dt / 2ˡ with the least level l for which it is at most √(2 η ε / |a|) (Springel 2005).
// A step of level l begins at a multiple of its length, so that a particle waits for such a time before its steps become longer.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(1) var<storage, read> due: array<u32>;
@group(1) @binding(2) var<storage, read> block_clock: array<BlockClock>;
@group(1) @binding(3) var<storage, read_write> step_level: array<u32>;
// The acceleration at the end of a particle's last step.
@group(1) @binding(4) var<storage, read_write> block_acceleration: array<vec4f>;
// The largest level, the lowest id of those that require more than there are, the most that one requires, and the number of those due.
@group(1) @binding(5) var<storage, read_write> block_wanted: array<atomic<u32>>;

override LEVELS: u32;
// dt² / (2 η ε), or without ε where particles have their own.
override DEMAND: f32;
const WORKGROUP: u32 = 64u;
// Above all levels that there are.
const TOO_MANY: u32 = 31u;

// The size of a vector whose square may be too small, or too large, to be held.
fn size(a: vec3f) -> f32 {
    let most = max(abs(a.x), max(abs(a.y), abs(a.z)));
    return select(0.0, most * length(a / most), most > 0.0);
}

@compute @workgroup_size(WORKGROUP)
fn block_level(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    var level = step_level[i];
    if due[i] != 0u {
        let a = acceleration[i];
        block_acceleration[i] = a;
        atomicAdd(&block_wanted[3], 1u);
        // The square of the number of steps in dt.
        var steps = DEMAND * size(a.xyz) / length_of(i);
        level = 0u;
        while steps > 1.0 && level < TOO_MANY {
            steps *= 0.25;
            level += 1u;
        }
        if level > LEVELS {
            atomicMin(&block_wanted[1], i);
            atomicMax(&block_wanted[2], level);
            level = LEVELS;
        }
        while (block_clock[0].now & ((1u << (LEVELS - level)) - 1u)) != 0u { level += 1u; }
        step_level[i] = level;
    }
    atomicMax(&block_wanted[0], level);
}
