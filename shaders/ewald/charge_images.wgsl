// The long-range part of the Ewald sum of charges, all images included (Ewald 1921):
// φ = Re S*(κ) exp(iκ·x), summed, less a charge's own smooth part;  F = −q ∇φ
@group(3) @binding(2) var<storage, read> structure: array<f32>;
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

// The wave vectors of the dispatch.
override FIRST: u32 = 0u;
override END: u32 = 126u;
// k P(1) / R: what the law between two lacks for a charge with itself.
override SELF: f32 = 1.0;
const WORKGROUP: u32 = 64u;
const BLOCK: u32 = 128u;

@compute @workgroup_size(WORKGROUP)
fn charge_images(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = position[i];
        // A particle without mass is moved by nothing.
        if me.w > 0.0 {
            var field = vec3f();
            var potential = -SELF * strength(i);
            // By blocks, so that rounding grows with the root of the number of waves in one, and of that of blocks.
            for (var first = FIRST; first < END; first += BLOCK) {
                var part = vec4f();
                let end = min(first + BLOCK, END);
                for (var wave = first; wave < end; wave += 1u) {
                    let k = wave_vector[wave].xyz;
                    let here = wave_at(k, me.xyz);
                    let re = structure[2u * wave];
                    let im = structure[2u * wave + 1u];
                    part += vec4f((here.y * re - here.x * im) * k, here.x * re + here.y * im);
                }
                field += part.xyz;
                potential += part.w;
            }
            // Each of a pair holds half of its potential energy.
            acceleration[i] += (strength(i) / me.w) * vec4f(TURN * world.frequency * field, 0.5 * potential);
        }
    }
}
