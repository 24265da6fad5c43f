// Sums the blocks of the structure factor, in their order: real and imaginary parts, by wave vector. The file beside it says what is kept of a
// sum: fn kept(wave: u32, sum: vec2f) -> vec2f.
@group(3) @binding(1) var<storage, read_write> structure_parts: array<vec2f>;
@group(3) @binding(2) var<storage, read_write> structure: array<f32>;

override BLOCKS: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn structure_sum(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let wave = folded(group, groups) * WORKGROUP + lane;
    if wave < WAVES {
        var sum = vec2f();
        for (var block = 0u; block < BLOCKS; block += 1u) { sum += structure_parts[block * WAVES + wave]; }
        let stored = kept(wave, sum);
        structure[2u * wave] = stored.x;
        structure[2u * wave + 1u] = stored.y;
    }
}
