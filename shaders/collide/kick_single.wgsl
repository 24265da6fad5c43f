// The way from one body to another, the difference of their velocities, and a change of a velocity.
fn apart(i: u32, j: u32) -> vec3f { return nearest_image(position[j].xyz - position[i].xyz); }
fn relative(i: u32, j: u32) -> vec3f { return velocity[j].xyz - velocity[i].xyz; }

fn kick(i: u32, change: vec3f) { velocity[i] += vec4f(change, 0.0); }
