// The long-range part of the Ewald sum: all images and the mean density beyond the faded law, including a particle's own images (Ewald 1921):
// φ = −(G / L) [Σ A(k) Re S*(k) exp(2πi k·x / L) − 2 P(1) m],  a = −∇φ
@group(3) @binding(1) var<storage, read> structure: array<f32>;
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

override G: f32 = 1.0;
// 2 P(1): what the faded law lacks for a particle with itself.
override SELF: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn mass_images(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = position[i];
        var pull = vec3f();
        var potential = SELF * me.w;
        for (var wave = 0u; wave < WAVES; wave += 1u) {
            let k = wave_vector[wave];
            let here = k.w * wave_at(k.xyz, me.xyz);
            let re = structure[2u * wave];
            let im = structure[2u * wave + 1u];
            pull += (here.x * im - here.y * re) * k.xyz;
            potential -= here.x * re + here.y * im;
        }
        let f = world.frequency.x;
        // Each of a pair holds half of its potential energy.
        acceleration[i] += (G * expansion() * f) * vec4f((6.2831855 * f) * pull, 0.5 * potential);
    }
}
