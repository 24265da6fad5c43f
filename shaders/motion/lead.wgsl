// Fixed and kinematic particles move on a straight line to their target position:  v = displacement / time,  set at the start of a step.
struct Way { way: vec3f, time: f32 }

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> holds: array<vec2u>;          // id, motion
@group(1) @binding(3) var<storage, read> home: array<vec4f>;           // xyz, in the order of `holds`

override FIRST: u32 = 0u;
override END: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn lead(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = FIRST + folded(group, groups) * WORKGROUP + lane;
    // A step of no length leads nowhere.
    if i < END && world.dt > 0.0 {
        let id = holds[i].x;
        let next = way(id, holds[i].y, home[i].xyz, position[id].xyz);
        velocity[id] = vec4f(nearest_image(next.way) / next.time, velocity[id].w);
    }
}
