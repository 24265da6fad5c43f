// What the search for collisions reads of each body: its radius, of one that is not active a number with which no sum is above zero; and how far from
// its place at the end of a step it may touch another: its radius, and the way that it has made.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius in pictures
@group(3) @binding(1) var<storage, read> collision_radius: array<f32>;
@group(3) @binding(3) var<storage, read_write> collision_size: array<f32>;
@group(3) @binding(4) var<storage, read_write> collision_bound: array<vec4f>; // x

override PATHS: f32; // 1: bodies may touch on their way
const WORKGROUP: u32 = 64u;
const GONE: f32 = -3e38;

@compute @workgroup_size(WORKGROUP)
fn collide_prepare(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    collision_size[i] = GONE;
    collision_bound[i] = vec4f();
    if is_active(i) {
        collision_size[i] = collision_radius[i];
        collision_bound[i] = vec4f(collision_radius[i] + PATHS * world.dt * length(velocity[i].xyz), 0.0, 0.0, 0.0);
    }
}
