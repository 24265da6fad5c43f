// The start of a step: it is saved, and the accelerations along it are guessed from the polynomial of the step before, which is extended
// beyond its end, or, where that step is tried again, taken over a shorter time.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(5) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(2) @binding(2) var<storage, read> radau_step: array<f32>;     // the length of the last step, 1 if it was accepted

const WORKGROUP: u32 = 64u;
// Beyond so many lengths of the last step its polynomial says nothing.
const FAR: f32 = 4.0;

// The polynomial from another start, with its length in the new step's: by its powers.
fn predicted(differences: array<vec3f, 7>, start: f32, ratio: f32) -> array<vec3f, 7> {
    var power: array<vec3f, 8>;
    for (var k = 0u; k < DIFFERENCES; k += 1u) { power[k + 1u] = differences[k]; }
    for (var k = DIFFERENCES - 1u; k > 0u; k -= 1u) {
        for (var j = k; j < DIFFERENCES; j += 1u) { power[j] -= NODE[k] * power[j + 1u]; }
    }
    for (var k = 1u; k <= DIFFERENCES; k += 1u) {
        for (var j = DIFFERENCES; j >= k; j -= 1u) { power[j - 1u] += start * power[j]; }
    }
    var scale = 1.0;
    for (var k = 1u; k <= DIFFERENCES; k += 1u) {
        scale *= ratio;
        power[k] *= scale;
    }
    for (var k = 1u; k < DIFFERENCES; k += 1u) {
        for (var j = DIFFERENCES; j > k; j -= 1u) { power[j - 1u] += NODE[k] * power[j]; }
    }
    var all: array<vec3f, 7>;
    for (var k = 0u; k < DIFFERENCES; k += 1u) { all[k] = power[k + 1u]; }
    return all;
}

@compute @workgroup_size(WORKGROUP)
fn radau_begin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    save(i);
    step_start[i * SLOTS + START_ACCELERATION] = acceleration[i];
    if world.dt > 0.0 {
        let last = radau_step[0];
        let known = last > 0.0 && world.dt <= FAR * last;
        let ratio = select(0.0, world.dt / last, known);
        var before: array<vec3f, 7>;
        for (var k = 0u; k < DIFFERENCES; k += 1u) { before[k] = acceleration_differences[i * DIFFERENCES + k].xyz; }
        let next = predicted(before, radau_step[1], ratio);
        for (var k = 0u; k < DIFFERENCES; k += 1u) {
            acceleration_differences[i * DIFFERENCES + k] = select(vec4f(), vec4f(next[k], 0.0), known);
        }
    }
    go(i);
}
