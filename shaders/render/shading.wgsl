// Tone mapping:  t = log(1 + L / knee) / log(1 + white / knee)  (Drago et al. 2003, with a fixed base)
// In canvas units; 1 / log2(1 + white / knee); how much darker ink is than light would be light.
struct Exposure { unused_word: u32, knee: f32, slope: f32, body: f32 }

@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth, radius
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(2) var<storage, read> canvas: array<u32>; // red, green, blue
@group(3) @binding(4) var<storage, read> owner: array<u32>;
@group(3) @binding(5) var<storage, read> streak: array<u32>; // brightness in the upper half, id in the lower
@group(3) @binding(8) var<uniform> exposure: Exposure;

const WORKGROUP: u32 = 64u;
// So many pixels of the picture are one of the bloom, each way.
const SHRINK: u32 = 4u;
const LAMP: vec3f = vec3f(-0.48, 0.6, 0.64); // right, up, towards the eye; of length 1
const HALFWAY: vec3f = vec3f(-0.265035, 0.331294, 0.905537); // between the lamp and the eye

fn pow2(x: f32) -> f32 { return x * x; }

// A ball under a lamp (Lambert 1760, Blinn 1977). Its edge is as soft as a pixel.
fn ball(under: vec3f, id: u32, place: vec2f) -> vec3f {
    let p = projected[id];
    let d = (place - p.xy) / p.w;
    let rho = dot(d, d);
    let normal = vec3f(d.x, -d.y, sqrt(max(1.0 - rho, 0.0)));
    let lit = max(dot(normal, LAMP), 0.0);
    let s2 = pow2(max(dot(normal, HALFWAY), 0.0));
    let shine = pow2(pow2(pow2(pow2(s2))));
    let shade = unpack4x8unorm(color[id]).rgb * (0.16 + 0.84 * lit) + 0.35 * shine;
    return mix(under, shade, clamp(p.w + 0.5 - p.w * sqrt(rho), 0.0, 1.0));
}

// The hue of the light, bleached where it is bright.
fn glow(light: vec3f) -> vec3f {
    let brightest = max(light.r, max(light.g, light.b));
    if brightest <= 0.0 { return vec3f(); }
    let t = exposure.slope * log2(1.0 + brightest / exposure.knee);
    let bleach = clamp(t - 0.55, 0.0, frame.bleach);
    return min(mix(light * (t / brightest), vec3f(t), bleach), vec3f(1.0));
}

// What is light on a dark sky is ink on a bright one, and keeps a breath of its hue.
fn ink(under: vec3f, light: vec3f) -> vec3f {
    let brightest = max(light.r, max(light.g, light.b));
    if brightest <= 0.0 { return under; }
    let t = exposure.slope * log2(1.0 + brightest / exposure.knee);
    return mix(under, light * (frame.tint / brightest), frame.ink * min(exposure.body * t, 1.0));
}

// Two lights on one pixel never pass white.
fn screen(a: vec3f, b: vec3f) -> vec3f { return a + b - a * b; }

// A pixel without its bloom, in front of a background.
fn shaded(i: u32, under: vec3f) -> vec3f {
    let place = middle(i32(i % frame.width), i32(i / frame.width));
    var c = under;
    if owner[i] != NONE { c = ball(c, owner[i], place); }
    let light = vec3f(f32(canvas[3u * i]), f32(canvas[3u * i + 1u]), f32(canvas[3u * i + 2u]));
    if frame.ink > 0.0 { c = ink(c, light); } else { c = screen(c, glow(light)); }
    let line = streak[i];
    if line != 0u {
        let trail = unpack4x8unorm(color[line & 0xffffu]).rgb;
        let bright = f32(line >> 16u) / 65535.0;
        if frame.ink > 0.0 { c = mix(c, frame.tint * trail, frame.ink * bright); } else { c = screen(c, trail * bright); }
    }
    return clamp(c, vec3f(0.0), vec3f(1.0));
}
