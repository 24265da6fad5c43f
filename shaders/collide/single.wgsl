// A body goes a part of the way to another, and takes that part of the difference of their velocities.
fn approach(i: u32, j: u32, weight: f32) {
    position[i] += vec4f(weight * nearest_image(position[j].xyz - position[i].xyz), 0.0);
    velocity[i] += vec4f(weight * (velocity[j].xyz - velocity[i].xyz), 0.0);
}
