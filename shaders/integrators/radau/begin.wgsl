// The start of a step: it is saved, and the accelerations along it are guessed from the polynomial of the step before, which is extended
// beyond its end, or, where that step is tried again, taken over a shorter time.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(5) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(2) @binding(2) var<storage, read> radau_step: array<f32>;     // the length of the last step, 1 if it was accepted

const WORKGROUP: u32 = 64u;
// Beyond so many lengths of the last step its polynomial says nothing.
const FAR: f32 = 4.0;

fn along(g: array<vec3f, 7>, h: f32) -> vec3f {
    var sum = vec3f();
    for (var k = DIFFERENCES; k > 0u; k -= 1u) { sum = (h - NODE[k - 1u]) * (sum + g[k - 1u]); }
    return sum;
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
        let start = along(before, radau_step[1]);
        var g: array<vec3f, 7>;
        for (var n = 1u; n <= DIFFERENCES; n += 1u) {
            var difference = (along(before, radau_step[1] + ratio * NODE[n]) - start) / NODE[n];
            for (var k = 1u; k < n; k += 1u) { difference = (difference - g[k - 1u]) / (NODE[n] - NODE[k]); }
            g[n - 1u] = difference;
            acceleration_differences[i * DIFFERENCES + n - 1u] = select(vec4f(), vec4f(difference, 0.0), known);
        }
    }
    go(i);
}
