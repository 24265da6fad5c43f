// The virial of pairs that bonds leave out.
@group(1) @binding(2) var<storage, read_write> virial: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn excluded_virial(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let all = taken_off(i);
        virial[2u * i] += vec4f(all.normal, 0.0);
        virial[2u * i + 1u] += vec4f(all.shear, all.size);
    }
}
