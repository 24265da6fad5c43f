// The structure factor of all particles, S(k) = Σ s exp(2πi k·x / L): each invocation sums a block of particles for one wave vector.
// The file beside it has the strength of a particle: fn strength(i: u32) -> f32.
@group(3) @binding(1) var<storage, read_write> structure_parts: array<vec2f>;

override BLOCK: u32 = 64u;
// The first wave vector of the dispatch.
override FIRST: u32 = 0u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn structure_factor(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let wave = FIRST + group.z * WORKGROUP + lane;
    let block = folded(group, groups);
    let first = block * BLOCK;
    let end = min(first + BLOCK, world.count);
    let some = first < end;
    if wave < WAVES && some {
        let k = wave_vector[wave].xyz;
        var sum = vec2f();
        for (var i = first; i < end; i += 1u) { sum += strength(i) * wave_at(k, position[i].xyz); }
        structure_parts[block * WAVES + wave] = sum;
    }
}
