// Density as a state, after a drift:  ρ ← ρ + c dρ/dt dt.
struct Params { unused_word: u32, factor: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(2) var<storage, read_write> density: array<f32>;
@group(3) @binding(3) var<storage, read> density_rate: array<f32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn density_advance(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) { density[i] += params.factor * world.dt * density_rate[i]; }
}
