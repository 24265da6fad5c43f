// The number of steps in a longest step T that the criteria of a fluid particle require (Monaghan 1992; Ihmsen et al. 2014), C the Courant number, s the
// smoothing length, d the spacing:  T / C √(|a| / s),  T / C (c + 0.6 α c + |μ|) / s,  T / C |v| / (0.4 d).  Walls require none, nor do particles
// that are not active.
struct Params { unused_word: u32, acceleration: f32, signal: f32, sound: f32, speed: f32 } // sound: c + 0.6 α c

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(2) var<storage, read> closing: array<f32>;
@group(1) @binding(3) var<storage, read_write> step_criteria: array<vec4f>;
@group(3) @binding(0) var<uniform> params: Params;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn criterion(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) {
        let a = params.acceleration * sqrt(length(acceleration[i].xyz));
        let criterion = vec4f(a, params.signal * (params.sound + closing[i]), params.speed * length(velocity[i].xyz), 0.0);
        step_criteria[i] = select(vec4f(), criterion, is_active(i));
    }
}
