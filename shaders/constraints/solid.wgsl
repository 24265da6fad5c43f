// A rigid obstacle: a particle closer than the margin to its surface is projected onto the margin, along n = ∇φ, and loses velocity to
// it, in the frame of the surface:  vₙ ← −e vₙ,  |Δvₜ| ≤ μ |Δvₙ|  (restitution: Newton 1687; friction: Coulomb 1785).
// The change of velocity acts from the time of contact on: x changes by it times the rest of the drift, so that a particle
// at rest does not creep.
struct Params {
    unused_word: u32,
    position: vec3f, radius: f32, size: vec3f, shape: u32, axis: vec3f, margin: f32,
    side: f32, restitution: f32, friction: f32, species: u32, motion: u32,
}
struct Frame { centre: vec3f, pivot: vec3f, turn: vec4f, velocity: vec3f, spin: vec3f }

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(3) var<storage, read> species: array<u32>;
@group(3) @binding(0) var<uniform> params: Params;

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;
const PLANE: u32 = 2u;

struct Touch { n: vec3f, depth: f32, r: vec3f }

// The depth of a particle below the margin, and the direction out.
fn touch(frame: Frame, x: vec3f) -> Touch {
    var r = x - frame.centre;
    // A plane has no images.
    if params.shape != PLANE { r = nearest_image(r); }
    let there = r + turned(vec4f(-frame.turn.xyz, frame.turn.w), r);
    let s = params.side * signed_distance(params.shape, there, params.radius, params.size, params.axis);
    return Touch(s.xyz + turned(frame.turn, s.xyz), params.margin - s.w, r);
}

@compute @workgroup_size(WORKGROUP)
fn solid(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && is_of(i, params.species) && !is_held(i) && is_active(i) {
        let frame = frame();
        let hit = touch(frame, position[i].xyz);
        if hit.depth > 0.0 {
            let v = velocity[i].xyz - frame.velocity - cross(frame.spin, frame.centre + hit.r - frame.pivot);
            let inward = -dot(v, hit.n);
            var way = hit.depth * hit.n;
            if inward > 0.0 {
                let along = v + inward * hit.n;
                let speed = length(along);
                let grip = params.friction * (1.0 + params.restitution) * inward;
                var slowed = along;
                if speed > grip { slowed = along * (grip / speed); }
                let bounce = params.restitution * inward * hit.n - slowed;
                velocity[i] += vec4f(bounce + inward * hit.n, 0.0);
                way += min(hit.depth / inward, max(FACTOR * world.dt, 0.0)) * bounce;
            }
            // The way along a curved wall, or back into a corner, may lead behind it again.
            let again = touch(frame, position[i].xyz + way);
            position[i] += vec4f(way + max(again.depth, 0.0) * again.n, 0.0);
        }
    }
}
