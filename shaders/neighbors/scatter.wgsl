// Scatters each particle into its cell, in the order of arrival.
@group(2) @binding(1) var<storage, read> starts: array<u32>;
@group(2) @binding(2) var<storage, read> keys: array<u32>;
@group(2) @binding(3) var<storage, read> arrivals: array<u32>;
@group(2) @binding(4) var<storage, read_write> slots: array<u32>;

const WORKGROUP: u32 = 64u;
const NOWHERE: u32 = 0xffffffffu;

@compute @workgroup_size(WORKGROUP)
fn scatter(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let k = keys[i];
        if k != NOWHERE { slots[starts[k] + arrivals[i]] = i; }
    }
}
