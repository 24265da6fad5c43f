// The virial of the long-range part of the Ewald sum of charges: −∂E / ∂ε of E = ½ Σ A |S|² under a strain ε of all lengths, with R as it is:
// W(κ) = E(κ) [1 − (2 − x w′(x) / w(x)) κ ⊗ κ / κ²], x = κ R (Nosé & Klein, Mol. Phys. 50, 1055, 1983, for another w).
@group(3) @binding(2) var<storage, read> structure: array<f32>;
// Two for each wave: xx, yy, zz; yz, xz, xy.
@group(3) @binding(4) var<storage, read_write> wave_virial: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn charge_virial(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let wave = folded(group, groups) * WORKGROUP + lane;
    if wave < WAVES {
        var normal = vec3f();
        var shear = vec3f();
        let k = wave_vector[wave].xyz;
        let size = amount(k);
        let stored = vec2f(structure[2u * wave], structure[2u * wave + 1u]);
        // A wave that is no part of the sum has none.
        if size != 0.0 {
            let half = 0.5 * dot(stored, stored) / size;
            let square = wave_square(k);
            normal = vec3f(half);
            if square > 0.0 {
                let ranges = square * RANGE * RANGE;
                let fall = 0.2 * ranges * bessel(SHARPNESS - ranges, 5.0) / bessel(SHARPNESS - ranges, 3.0);
                let turns = TURN * k * world.frequency;
                let along = half * (2.0 + fall) / square;
                normal -= along * turns * turns;
                shear -= along * turns.yxx * turns.zzy;
            }
        }
        wave_virial[2u * wave] = vec4f(normal, 0.0);
        wave_virial[2u * wave + 1u] = vec4f(shear, 0.0);
    }
}
