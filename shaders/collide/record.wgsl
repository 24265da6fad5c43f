// After bodies have merged: the one that remains has the volume of both, and must not outgrow the search; the other keeps the id of that one, and
// the time.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>;
@group(3) @binding(1) var<storage, read_write> collision_radius: array<f32>;
@group(3) @binding(3) var<storage, read_write> merged_into: array<u32>; // 1 + id; 0: none
@group(3) @binding(4) var<storage, read_write> merge_time: array<f32>;

override LARGEST: f32; // the largest radius for the range of the search
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn collide_record(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let j = collided(i);
    if j == NONE { return; }
    if is_active(i) {
        let radius = of_both(collision_radius[i], collision_radius[j]);
        collision_radius[i] = radius;
        if radius > LARGEST { atomicMin(&alarm[14], i); }
    } else {
        merged_into[i] = 1u + id_of(j);
        let end = now(1.0);
        merge_time[i] = (f32(end.whole) + end.rest) * end.unit;
    }
}
