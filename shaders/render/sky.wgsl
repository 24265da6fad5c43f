// Skies: a night, a little lighter in the middle; or a dusk, mixed downwards from slate to rose to amber, bright where the sun
// has set:  glow = 2^(−d² / S²);  or a day, from blue to haze; water from above, lighter in the middle; white paper
const SLATE: vec3f = vec3f(0.26, 0.31, 0.47);
const ROSE: vec3f = vec3f(0.76, 0.55, 0.58);
const AMBER: vec3f = vec3f(0.94, 0.68, 0.46);
const SUN: vec3f = vec3f(0.10, 0.09, 0.01);

fn night(place: vec2f, size: vec2f) -> vec3f {
    let off = place / size - 0.5;
    return frame.sky * mix(vec3f(0.036, 0.043, 0.072), vec3f(0.008, 0.009, 0.018), clamp(2.0 * dot(off, off), 0.0, 1.0));
}

fn dusk(place: vec2f, size: vec2f) -> vec3f {
    let fall = place.y / size.y;
    let air = mix(mix(SLATE, ROSE, smoothstep(0.0, 0.7, fall)), AMBER, smoothstep(0.5, 1.0, fall));
    let off = (place - size * vec2f(0.62, 1.04)) / (0.42 * size.y);
    return air + SUN * exp2(-dot(off, off));
}

const ZENITH: vec3f = vec3f(0.60, 0.72, 0.86);
const HAZE: vec3f = vec3f(0.93, 0.94, 0.95);

fn day(place: vec2f, size: vec2f) -> vec3f { return mix(ZENITH, HAZE, smoothstep(0.0, 0.8, place.y / size.y)); }

fn sea(place: vec2f, size: vec2f) -> vec3f {
    let off = place / size - 0.5;
    return mix(vec3f(0.06, 0.31, 0.36), vec3f(0.015, 0.12, 0.20), smoothstep(0.0, 0.5, dot(off, off)));
}

fn background(place: vec2f) -> vec3f {
    let size = vec2f(f32(frame.width), f32(frame.height));
    if frame.sky > 3.0 { return vec3f(1.0); }
    if frame.sky > 2.0 { return sea(place, size); }
    if frame.ink == 0.0 { return night(place, size); }
    if frame.sky > 1.0 { return day(place, size); }
    return dusk(place, size);
}
