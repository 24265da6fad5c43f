// A particle with a target reaches it at the target's time, or at the end of the step if that is earlier, and then stays.
@group(1) @binding(4) var<storage, read> kinematic_target: array<vec4f>; // xyz, time; by id

fn way(id: u32, motion: u32, home: vec3f, x: vec3f) -> Way {
    let to = kinematic_target[id];
    return Way(to.xyz - x, max(to.w - begun(), world.dt));
}
