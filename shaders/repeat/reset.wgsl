// Resets a loop: no iteration has workgroups, and the count is zero.
@group(0) @binding(0) var<storage, read_write> odd: array<u32>;
@group(0) @binding(1) var<storage, read_write> even: array<u32>;
@group(0) @binding(2) var<storage, read_write> iterations: array<u32>;

override WORDS: u32;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn reset(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < WORDS {
        odd[k] = 0u;
        even[k] = 0u;
    }
    if k == 0u {
        iterations[0] = 0u;
    }
}
