// A step with block time steps begins: every particle begins a step of its own.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> due: array<u32>;
@group(1) @binding(1) var<storage, read_write> block_clock: array<BlockClock>;
// The largest level, the lowest id of those that require more than there are, the most that one requires, and the number of those due.
@group(1) @binding(2) var<storage, read_write> block_wanted: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn block_begin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { due[i] = 1u; }
    if i == 0u {
        block_clock[0].now = 0u;
        block_wanted[0] = 0u;
        block_wanted[1] = ~0u;
        block_wanted[2] = 0u;
        block_wanted[3] = 0u;
    }
}
