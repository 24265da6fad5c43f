// The finished picture: sky, surfaces and particles in front of it, bloom around bright pixels, and dithering against banding.
@group(3) @binding(7) var<storage, read_write> pixels: array<u32>; // red, green, blue, 255 from the lowest byte on
@group(3) @binding(9) var<storage, read> bloom: array<vec4f>;
@group(3) @binding(15) var<storage, read> scenery: array<u32>; // red, green, blue, and how much of the pixel they cover

fn near(x: i32, y: i32) -> vec3f {
    let columns = i32((frame.width + SHRINK - 1u) / SHRINK);
    let rows = i32((frame.height + SHRINK - 1u) / SHRINK);
    return bloom[clamp(y, 0, rows - 1) * columns + clamp(x, 0, columns - 1)].rgb;
}

// Between four pixels of the bloom.
fn bloom_at(place: vec2f) -> vec3f {
    let q = place / f32(SHRINK) - 0.5;
    let part = q - floor(q);
    let x = i32(floor(q.x));
    let y = i32(floor(q.y));
    return mix(mix(near(x, y), near(x + 1, y), part.x), mix(near(x, y + 1), near(x + 1, y + 1), part.x), part.y);
}

// A hash of integers (Wellons 2018), as a number in [0, 1).
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
        let light = frame.bloom * bloom_at(place);
        let behind = unpack4x8unorm(scenery[i]);
        let c = screen(shaded(i, mix(background(place), behind.rgb, behind.a)), light / (1.0 + light));
        let bytes = vec3u(clamp(c, vec3f(0.0), vec3f(1.0)) * 255.0 + noise(i));
        pixels[i] = 0xff000000u | (min(bytes.b, 255u) << 16u) | (min(bytes.g, 255u) << 8u) | min(bytes.r, 255u);
    }
}
