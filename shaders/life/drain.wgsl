// An active particle inside of a drain's solid, or outside of it, where nothing is in the way, is removed: it stays there at rest, without mass.
struct Params { unused_word: u32, position: vec3f, radius: f32, size: vec3f, shape: u32, axis: vec3f, side: f32, species: u32 }

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(3) var<storage, read> species: array<u32>;
@group(1) @binding(8) var<storage, read_write> life: array<u32>;           // 0 pending, 1 active, 2 removed
@group(3) @binding(0) var<uniform> params: Params;

const WORKGROUP: u32 = 64u;
const PLANE: u32 = 2u;

@compute @workgroup_size(WORKGROUP)
fn drain(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && life[i] == 1u && is_of(i, params.species) && !is_held(i) {
        var r = position[i].xyz - params.position;
        // A plane has no images.
        if params.shape != PLANE { r = nearest_image(r); }
        if params.side * signed_distance(params.shape, r, params.radius, params.size, params.axis).w < 0.0 && is_free(position[i].xyz, r) {
            life[i] = 2u;
            position[i].w = 0.0;
            velocity[i] = vec4f(vec3f(), velocity[i].w);
            acceleration[i] = vec4f();
        }
    }
}
