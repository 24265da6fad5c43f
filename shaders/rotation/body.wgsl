// A rigid body: q turns components along its principal axes into space, I are its moments about them.
@group(1) @binding(3) var<storage, read> inertia: array<vec4f>;

// A vector in space, along the principal axes.
fn inward(q: vec4f, v: vec3f) -> vec3f { return v + turned(vec4f(-q.xyz, q.w), v); }

fn outward(q: vec4f, v: vec3f) -> vec3f { return v + turned(q, v); }

// 1 / I; a body does not rotate about an axis without a moment.
fn lightness(i: u32) -> vec3f {
    let moments = inertia[i].xyz;
    return select(vec3f(), 1.0 / moments, moments > vec3f());
}
