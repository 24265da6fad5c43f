// Avoiding an obstacle (containment; Reynolds 1999) by its signed distance φ:  a = f_max (1 − s / L) (−h · ∇φ) ∇φ,  with h the
// heading, L = τ |v| the look-ahead distance, s the distance to the point where a bird of radius c touches, ∇φ evaluated there.
// A particle that touches already, or is inside, is pushed straight out:  a = f_max ∇φ.
struct Params {
    unused_word: u32,
    position: vec3f, radius: f32, size: vec3f, shape: u32, normal: vec3f,
    look_ahead: f32, clearance: f32, max_force: f32, species: u32,
}

@group(3) @binding(0) var<uniform> params: Params;

// ∇φ and φ
fn surface(x: vec3f) -> vec4f {
    var d = x - params.position;
    // A plane has no images.
    if params.shape != 2u { d = shortest(d); }
    return signed_distance(params.shape, d, params.radius, params.size, params.normal);
}

fn force(me: Particle) -> vec4f {
    if !is_of(me.index, params.species) { return vec4f(); }
    let v = velocity_of(me);
    let h = unit(v);
    let ahead = params.look_ahead * length(v);
    // Sphere tracing (Hart 1996): where φ is the distance, so far the way is free.
    var s = 0.0;
    for (var k = 0u; k < 8u; k += 1u) {
        s += max(surface(me.position + s * h).w - params.clearance, 0.0);
    }
    let out = surface(me.position + s * h).xyz;
    if s == 0.0 { return vec4f(params.max_force * out, 0.0); }
    if s >= ahead { return vec4f(); }
    return vec4f((params.max_force * (1.0 - s / ahead) * max(-dot(h, out), 0.0)) * out, 0.0);
}
