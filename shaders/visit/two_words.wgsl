// Positions have two words, x = x₁ + x₂: to the difference of the first ones, which is exact for near particles (Sterbenz 1974), the
// difference of the second ones is added before anything is rounded at the size of a coordinate.
@group(1) @binding(7) var<storage, read> position_low: array<vec4f>; // xyz

fn refined(r: vec3f, me: Particle, you: Particle) -> vec3f {
    return r + (position_low[you.index].xyz - position_low[me.index].xyz);
}
