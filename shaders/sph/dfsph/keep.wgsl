// A step ends: κ is saved for the warm start of the next one. Statistics of its two solves: steps, those that did not
// converge, the first of them, the most iterations, those of this step, and those of all.
@group(3) @binding(7) var<storage, read> dfsph_state: array<State>;
@group(3) @binding(8) var<storage, read> stiffness: array<Stiffness>;
@group(3) @binding(9) var<storage, read_write> warm_start: array<Stiffness>;
@group(3) @binding(13) var<storage, read_write> dfsph_report: array<u32>;
@group(3) @binding(14) var<storage, read_write> dfsph_errors: array<f32>;

const WORDS: u32 = 6u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn keep(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { warm_start[i] = stiffness[i]; }
    if i < 2u {
        let state = dfsph_state[i];
        let iterations = u32(state.iterations);
        let base = i * WORDS;
        if state.code != 1.0 {
            if dfsph_report[base + 1u] == 0u { dfsph_report[base + 2u] = world.step; }
            dfsph_report[base + 1u] += 1u;
        }
        dfsph_report[base] += 1u;
        dfsph_report[base + 3u] = max(dfsph_report[base + 3u], iterations);
        dfsph_report[base + 4u] = iterations;
        dfsph_report[base + 5u] += iterations;
        dfsph_errors[i] = state.error;
    }
}
