// Clears the canvas.
@group(3) @binding(1) var<storage, read_write> not_drawn: array<u32>;
@group(3) @binding(2) var<storage, read_write> canvas: array<u32>;
@group(3) @binding(3) var<storage, read_write> front: array<u32>;
@group(3) @binding(4) var<storage, read_write> owner: array<u32>;
@group(3) @binding(5) var<storage, read_write> streak: array<u32>;
@group(3) @binding(6) var<storage, read_write> histogram: array<u32>;

const WORKGROUP: u32 = 64u;
const BINS: u32 = 256u;

@compute @workgroup_size(WORKGROUP)
fn clear(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        canvas[3u * i] = 0u;
        canvas[3u * i + 1u] = 0u;
        canvas[3u * i + 2u] = 0u;
        front[i] = NONE;
        owner[i] = NONE;
        streak[i] = 0u;
    }
    if i < BINS { histogram[i] = 0u; }
    if i < 2u { not_drawn[i] = 0u; }
}
