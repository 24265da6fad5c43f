// Raises the alarm when a column that is advanced is not finite: the first step in which that is seen, and the
// lowest id of a particle there, as for positions.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> value: array<Value>;
@group(1) @binding(1) var<storage, read_write> alarm: array<atomic<u32>>; // 0 steps done, 1 id

override ELEMENTS: u32 = 1u;
override SLOTS: u32 = 1u;
override AHEAD: u32 = 0u; // steps that are done once this kernel has run, beyond those that are counted

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn watch_column(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS && is_broken(value[i]) {
        // Later checks find an earlier step already stored, and do not change the id.
        let done = world.step + AHEAD;
        if atomicMin(&alarm[0], done) >= done { atomicMin(&alarm[1], i / SLOTS); }
    }
}
