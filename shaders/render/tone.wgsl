// From light to a picture:  t = log(1 + L / knee) / log(1 + white / knee)  (Drago et al. 2003, with a fixed base)
struct Exposure { knee: f32, slope: f32 } // in canvas units; 1 / log2(1 + white / knee)

@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth, radius
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(2) var<storage, read> canvas: array<u32>; // red, green, blue
@group(3) @binding(4) var<storage, read> owner: array<u32>;
@group(3) @binding(5) var<storage, read> streak: array<u32>; // brightness in the upper half, id in the lower
@group(3) @binding(7) var<storage, read_write> pixels: array<u32>; // red, green, blue, 255 from the lowest byte on
@group(3) @binding(8) var<uniform> exposure: Exposure;

const WORKGROUP: u32 = 64u;
const LAMP: vec3f = vec3f(-0.48, 0.6, 0.64); // right, up, towards the eye; of length 1
const HALFWAY: vec3f = vec3f(-0.265035, 0.331294, 0.905537); // between the lamp and the eye

// A night sky, a little lighter in the middle.
fn background(place: vec2f) -> vec3f {
    let size = vec2f(f32(frame.width), f32(frame.height));
    let off = place / size - 0.5;
    return frame.sky * mix(vec3f(0.036, 0.043, 0.072), vec3f(0.008, 0.009, 0.018), clamp(2.0 * dot(off, off), 0.0, 1.0));
}

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

fn pow2(x: f32) -> f32 { return x * x; }

// The hue of the light, bleached where it is bright.
fn glow(light: vec3f) -> vec3f {
    let brightest = max(light.r, max(light.g, light.b));
    if brightest <= 0.0 { return vec3f(); }
    let t = exposure.slope * log2(1.0 + brightest / exposure.knee);
    let bleach = clamp(t - 0.55, 0.0, 0.6);
    return min(mix(light * (t / brightest), vec3f(t), bleach), vec3f(1.0));
}

// Two lights on one pixel never pass white.
fn screen(a: vec3f, b: vec3f) -> vec3f { return a + b - a * b; }

// A hash of whole numbers (Wellons 2018), as a number in [0, 1).
fn noise(n: u32) -> f32 {
    var h = n;
    h = (h ^ (h >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return f32((h ^ (h >> 16u)) >> 8u) / 16777216.0;
}

@compute @workgroup_size(WORKGROUP)
fn tone(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let place = middle(i32(i % frame.width), i32(i / frame.width));
        var c = background(place);
        if owner[i] != NOBODY { c = ball(c, owner[i], place); }
        c = screen(c, glow(vec3f(f32(canvas[3u * i]), f32(canvas[3u * i + 1u]), f32(canvas[3u * i + 2u]))));
        let line = streak[i];
        if line != 0u { c = screen(c, unpack4x8unorm(color[line & 0xffffu]).rgb * (f32(line >> 16u) / 65535.0)); }
        // Dither: half a level of noise instead of bands.
        let bytes = vec3u(clamp(c, vec3f(0.0), vec3f(1.0)) * 255.0 + noise(i));
        pixels[i] = 0xff000000u | (min(bytes.b, 255u) << 16u) | (min(bytes.g, 255u) << 8u) | min(bytes.r, 255u);
    }
}
