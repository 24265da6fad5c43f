// The limiting particle: the lowest id of those with the maximum criterion.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> step_clock: array<atomic<u32>>; // 4 reason, 5 particle; 6 to 8 the alarm: step, reason, particle
@group(1) @binding(1) var<storage, read> step_criteria: array<vec4f>;
@group(1) @binding(2) var<storage, read> largest_criterion: array<vec4f>;

const WORKGROUP: u32 = 64u;

fn limits(i: u32, reason: u32) -> bool {
    return (reason == 1u && step_criteria[i].x == largest_criterion[0].x) || (reason == 2u && step_criteria[i].y == largest_criterion[0].y)
        || (reason == 4u && step_criteria[i].z == largest_criterion[0].z);
}

@compute @workgroup_size(WORKGROUP)
fn limiting_particle(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        if limits(i, atomicLoad(&step_clock[4])) { atomicMin(&step_clock[5], i); }
        if atomicLoad(&step_clock[6]) == world.step && limits(i, atomicLoad(&step_clock[7])) { atomicMin(&step_clock[8], i); }
    }
}
