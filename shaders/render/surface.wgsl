// The surface of a fluid before it is smooth: its depth, its thickness along the line of sight, and its dye.
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(16) var<storage, read> crest: array<u32>;
@group(3) @binding(17) var<storage, read> volume: array<u32>;
@group(3) @binding(19) var<storage, read> source: array<u32>;
@group(3) @binding(20) var<storage, read_write> level: array<f32>;
@group(3) @binding(21) var<storage, read_write> thickness: array<f32>;
@group(3) @binding(22) var<storage, read_write> dye: array<u32>;

const WORKGROUP: u32 = 64u;
// The depth where there is no fluid.
const NEVER: f32 = 1e30;

// The depth of a key.
fn unkey(k: u32) -> f32 { return bitcast<f32>(select(~k, k & 0x7fffffffu, k >= 0x80000000u)); }

@compute @workgroup_size(WORKGROUP)
fn levels(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        level[i] = NEVER;
        thickness[i] = 0.0;
        dye[i] = 0u;
        if crest[i] != NONE {
            level[i] = unkey(crest[i]);
            thickness[i] = frame.layer * f32(volume[i]);
            dye[i] = color[source[i]];
        }
    }
}
