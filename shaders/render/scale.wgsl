// The scale of values, from blue through pale to gold, lighter with the value: linear interpolation between five colours.
fn map(part: f32) -> vec3f {
    let t = 4.0 * part;
    var c = mix(vec3f(0.26, 0.28, 0.84), vec3f(0.29, 0.54, 0.96), clamp(t, 0.0, 1.0));
    c = mix(c, vec3f(0.52, 0.79, 0.94), clamp(t - 1.0, 0.0, 1.0));
    c = mix(c, vec3f(0.96, 0.90, 0.74), clamp(t - 2.0, 0.0, 1.0));
    let last = clamp(t - 3.0, 0.0, 1.0);
    return mix(c, vec3f(1.0, 0.77, 0.38), last);
}
