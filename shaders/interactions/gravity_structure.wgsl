// The structure factor of all particles, S(k) = Σ m exp(2πi k·x / L): each invocation sums a block of particles for one wave vector.
@group(3) @binding(1) var<storage, read_write> structure_parts: array<vec2f>;

override BLOCK: u32 = 64u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn gravity_structure(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let wave = group.z * WORKGROUP + lane;
    let block = folded(group, groups);
    let first = block * BLOCK;
    let end = min(first + BLOCK, world.count);
    let some = first < end;
    if wave < WAVES && some {
        let k = gravity_wave[wave].xyz;
        var sum = vec2f();
        for (var i = first; i < end; i += 1u) {
            let p = position[i];
            sum += p.w * wave_at(k, p.xyz);
        }
        structure_parts[block * WAVES + wave] = sum;
    }
}
