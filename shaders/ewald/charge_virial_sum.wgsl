// Adds the virial of all waves to that of particles. Only the sum over all particles has a meaning: each takes some of the waves.
@group(0) @binding(0) var<uniform> world: World;
@group(3) @binding(4) var<storage, read_write> wave_virial: array<vec4f>;
@group(1) @binding(2) var<storage, read_write> virial: array<vec4f>;

override WAVES: u32 = 126u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn charge_virial_sum(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        var normal = vec4f();
        var shear = vec4f();
        for (var wave = i; wave < WAVES; wave += world.count) {
            normal += wave_virial[2u * wave];
            shear += wave_virial[2u * wave + 1u];
        }
        virial[2u * i] += normal;
        virial[2u * i + 1u] += shear;
    }
}
