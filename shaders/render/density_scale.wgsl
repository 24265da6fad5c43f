// From mass to colours:  t = log(1 + Σ / knee) / log(1 + brightest / knee), on a scale whose lightness grows from end to end.
struct Exposure { unused_word: u32, knee: f32, slope: f32 }

@group(3) @binding(2) var<storage, read> canvas: array<u32>; // red has it all
@group(3) @binding(7) var<storage, read_write> pixels: array<u32>; // red, green, blue, 255 from the lowest byte on
@group(3) @binding(8) var<uniform> exposure: Exposure;
@group(3) @binding(15) var<storage, read> scenery: array<u32>; // red, green, blue, and how much of the pixel they cover

const WORKGROUP: u32 = 64u;
const STEPS: f32 = 5.0;

fn scale(k: u32) -> vec3f {
    switch k {
        case 0u: { return vec3f(0.01, 0.01, 0.03); }
        case 1u: { return vec3f(0.13, 0.06, 0.31); }
        case 2u: { return vec3f(0.43, 0.09, 0.43); }
        case 3u: { return vec3f(0.78, 0.22, 0.32); }
        case 4u: { return vec3f(0.97, 0.55, 0.16); }
        default: { return vec3f(0.99, 0.95, 0.7); }
    }
}

@compute @workgroup_size(WORKGROUP)
fn density_scale(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        // Beyond its end the scale has its last colour.
        let t = exposure.slope * log2(1.0 + f32(canvas[3u * i]) / exposure.knee);
        let place = t * STEPS;
        let low = u32(place);
        let behind = unpack4x8unorm(scenery[i]);
        let under = mix(scale(0u), behind.rgb, behind.a);
        let c = mix(under, mix(scale(low), scale(low + 1u), place - f32(low)), min(4.0 * t, 1.0));
        let bytes = vec3u(c * 255.0 + 0.5);
        pixels[i] = 0xff000000u | (bytes.b << 16u) | (bytes.g << 8u) | bytes.r;
    }
}
