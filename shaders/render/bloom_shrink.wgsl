// The picture at a quarter of its size, for the bloom: means of blocks of pixels.
@group(3) @binding(9) var<storage, read_write> bloom: array<vec4f>;

@compute @workgroup_size(WORKGROUP)
fn shrink(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    let columns = (frame.width + SHRINK - 1u) / SHRINK;
    let rows = (frame.height + SHRINK - 1u) / SHRINK;
    if i < columns * rows {
        let left = (i % columns) * SHRINK;
        let top = (i / columns) * SHRINK;
        var sum = vec3f();
        for (var y = top; y < min(top + SHRINK, frame.height); y += 1u) {
            for (var x = left; x < min(left + SHRINK, frame.width); x += 1u) {
                sum += shaded(y * frame.width + x, vec3f());
            }
        }
        bloom[i] = vec4f(sum / f32(SHRINK * SHRINK), 0.0);
    }
}
