// Particles whose own step begins are kicked by half of it; all drift to the end of the part, x ← x + v dt. Those whose step ends there
// are due.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;   // xyz, potential
@group(1) @binding(3) var<storage, read> step_level: array<u32>;
@group(1) @binding(4) var<storage, read> block_clock: array<BlockClock>;
@group(1) @binding(5) var<storage, read_write> due: array<u32>;

override LEVELS: u32;
// Whether all take the shortest step of any.
override SHARED: bool;
// Heavier ones do.
override MASS: f32;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn block_kick_drift(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let v = velocity[i];
        let own = 1u << (LEVELS - select(step_level[i], block_clock[0].finest, SHARED || x.w > MASS));
        // Parts of the step are powers of two, so that nothing is rounded here.
        let half = 0.5 * (world.dt * (f32(own) / f32(block_clock[0].now - block_clock[0].start)));
        let begins = (block_clock[0].start & (own - 1u)) == 0u;
        let faster = select(v.xyz, v.xyz + half * acceleration[i].xyz, begins);
        velocity[i] = vec4f(faster, v.w);
        position[i] = vec4f(x.xyz + world.dt * faster, x.w);
        due[i] = select(0u, 1u, (block_clock[0].now & (own - 1u)) == 0u);
    }
}
