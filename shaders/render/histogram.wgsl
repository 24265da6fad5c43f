// The luminance histogram of the pixels: eight bins for each doubling, by the bits of the number.
@group(3) @binding(2) var<storage, read> canvas: array<u32>; // red, green, blue
@group(3) @binding(6) var<storage, read_write> histogram: array<atomic<u32>>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn luminance_histogram(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let light = max(canvas[3u * i], max(canvas[3u * i + 1u], canvas[3u * i + 2u]));
        if light > 0u {
            let octave = firstLeadingBit(light);
            let wide = octave >= 3u;
            let eighth = select(light << (3u - octave), light >> (octave - 3u), wide) & 7u;
            atomicAdd(&histogram[8u * octave + eighth], 1u);
        }
    }
}
