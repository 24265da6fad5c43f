// Each particle is a small square that faces the eye, drawn from the simulation's own position buffer.
struct View { camera: mat4x4f, aspect: f32, size: f32, disk: f32 }

@group(0) @binding(0) var<uniform> view: View;

struct Corner { @builtin(position) clip: vec4f, @location(0) place: vec2f, @location(1) color: vec3f }

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) id: u32, @location(0) position: vec4f) -> Corner {
    let place = vec2f(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    var clip = view.camera * vec4f(position.xyz, 1.0);
    clip += vec4f(place.x * view.size / view.aspect, place.y * view.size, 0.0, 0.0);
    let halo = step(view.disk, f32(id));
    return Corner(clip, place, mix(vec3f(1.0, 0.72, 0.42), vec3f(0.42, 0.62, 1.0), halo));
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let light = exp(-4.0 * dot(corner.place, corner.place)) * 0.35;
    return vec4f(corner.color * light, 1.0);
}
