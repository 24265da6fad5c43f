// The distance to an exit before ways are found: that of the cells next to it, FAR of all others on the floor, and 0 of the rest.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> cell_known: array<f32>;
@group(1) @binding(1) var<storage, read_write> exit_distance: array<f32>;
@group(1) @binding(2) var<storage, read_write> exit_distance_next: array<f32>;

override COUNT: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn exits(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < COUNT {
        exit_distance[k] = cell_known[k];
        exit_distance_next[k] = cell_known[k];
    }
}
