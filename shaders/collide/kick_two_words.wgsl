// The same in two words.
@group(1) @binding(3) var<storage, read> position_low: array<vec4f>;       // xyz
@group(1) @binding(4) var<storage, read_write> velocity_low: array<vec4f>; // xyz

fn apart(i: u32, j: u32) -> vec3f {
    return nearest_image(hidden(position[j].xyz - position[i].xyz)) + (position_low[j].xyz - position_low[i].xyz);
}

fn relative(i: u32, j: u32) -> vec3f {
    return hidden(velocity[j].xyz - velocity[i].xyz) + (velocity_low[j].xyz - velocity_low[i].xyz);
}

fn kick(i: u32, change: vec3f) {
    let v = two_sum(velocity[i].xyz, change);
    let next = fast_two_sum(v.high, v.low + velocity_low[i].xyz);
    velocity[i] = vec4f(next.high, velocity[i].w);
    velocity_low[i] = vec4f(next.low, 0.0);
}
