// Particles whose own step ends are kicked by half of it. The others keep the acceleration with which their step began: a law evaluates
// theirs or not, as it likes.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius
@group(1) @binding(1) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(2) var<storage, read> block_acceleration: array<vec4f>;
@group(1) @binding(3) var<storage, read> step_level: array<u32>;
@group(1) @binding(4) var<storage, read> block_clock: array<BlockClock>;
@group(1) @binding(5) var<storage, read> due: array<u32>;
@group(1) @binding(6) var<storage, read> position: array<vec4f>; // xyz, mass

override LEVELS: u32;
// Whether all take the shortest step of any.
override SHARED: bool;
// Heavier ones do.
override MASS: f32;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn block_kick(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        if due[i] != 0u {
            let v = velocity[i];
            let own = 1u << (LEVELS - select(step_level[i], block_clock[0].finest, SHARED || position[i].w > MASS));
            let half = 0.5 * (world.dt * (f32(own) / f32(block_clock[0].now - block_clock[0].start)));
            velocity[i] = vec4f(v.xyz + half * acceleration[i].xyz, v.w);
        } else {
            acceleration[i] = block_acceleration[i];
        }
    }
}
