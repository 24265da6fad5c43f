// The same where positions and velocities have two words, of which the other body's low word of the velocity becomes 0.
@group(1) @binding(3) var<storage, read_write> position_low: array<vec4f>; // xyz
@group(1) @binding(4) var<storage, read_write> velocity_low: array<vec4f>; // xyz

fn approach(i: u32, j: u32, weight: f32) {
    let r = Words(nearest_image(hidden(position[j].xyz - position[i].xyz)), position_low[j].xyz - position_low[i].xyz);
    let x = advanced(Words(position[i].xyz, position_low[i].xyz), r, weight, 0.0);
    position[i] = vec4f(x.high, position[i].w);
    position_low[i] = vec4f(x.low, 0.0);
    let u = Words(hidden(velocity[j].xyz - velocity[i].xyz), velocity_low[j].xyz - velocity_low[i].xyz);
    let v = advanced(Words(velocity[i].xyz, velocity_low[i].xyz), u, weight, 0.0);
    velocity[i] = vec4f(v.high, velocity[i].w);
    velocity_low[i] = vec4f(v.low, 0.0);
    velocity_low[j] = vec4f();
}
