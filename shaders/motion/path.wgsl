// A kinematic particle is at the position that its prescribed motion has at the end of the step.
fn way(id: u32, motion: u32, home: vec3f, x: vec3f) -> Way {
    let there = pose(motion, 1.0);
    return Way((home - x) + (there.shift + turned(there.turn, home - motions[motion].about)), world.dt);
}
