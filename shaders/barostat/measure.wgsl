// The parts of a particle in d P V = Σ m v² − Σ r · F (Clausius 1870): m v² and its virial; and 1 where forces of pairs do not add up to the
// force on it.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> virial: array<vec4f>;   // see visit/virial.wgsl
@group(1) @binding(3) var<storage, read_write> pressure_parts: array<vec4f>;

// The part of the sizes of the forces by which they may fail to add up.
override ROUNDING: f32 = 0.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn pressure_measure(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i].xyz;
        let normal = virial[2u * i];
        let adds_up = normal.w <= ROUNDING * virial[2u * i + 1u].w;
        pressure_parts[i] = vec4f(position[i].w * dot(v, v), normal.x + normal.y + normal.z, select(1.0, 0.0, adds_up), 0.0);
    }
}
