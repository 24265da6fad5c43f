// A speed within limits:  v ← v clamp(|v|, min, max) / |v|;  a particle at rest starts along x if the minimum is above 0.
struct Params { unused_word: u32, least: f32, most: f32, species: u32 }

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(3) var<storage, read> species: array<u32>;
@group(3) @binding(0) var<uniform> params: Params;

const WORKGROUP: u32 = 64u;

fn limited(v: vec3f) -> vec3f {
    let speed = length(v);
    if speed > params.most { return v * (params.most / speed); }
    if speed < params.least {
        if speed > 0.0 { return v * (params.least / speed); }
        return vec3f(params.least, 0.0, 0.0);
    }
    return v;
}

@compute @workgroup_size(WORKGROUP)
fn speed_limit(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && is_of(i, params.species) && !is_held(i) && is_active(i) {
        let v = velocity[i];
        velocity[i] = vec4f(limited(v.xyz), v.w);
    }
}
