// A Gaussian trap along a line (Ashkin et al. 1986):  φ = −U exp(−2 ρ² / w²)
struct Params { unused_word: u32, position: vec3f, axis: vec3f, waist: f32, depth: f32 }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    let away = me.position - params.position;
    // A line has images at a distance only across the sides that it does not cross.
    let d = select(away, shortest(away), params.axis == vec3f());
    let across = (d - params.axis * dot(params.axis, d)) / params.waist;
    let potential = -params.depth * exp(-2.0 * dot(across, across));
    return vec4f(4.0 / params.waist * potential * across, potential);
}
