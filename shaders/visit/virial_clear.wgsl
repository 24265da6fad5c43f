// Sets the virial of each particle to zero.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> virial: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn virial_clear(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.capacity {
        virial[2u * i] = vec4f();
        virial[2u * i + 1u] = vec4f();
    }
}
