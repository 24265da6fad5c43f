// Steering (Reynolds 1999), for laws that use it:  a = truncate(u − v, f_max), with u the desired velocity.

// The direction of v; zero for a zero vector.
fn unit(v: vec3f) -> vec3f {
    let size = length(v);
    if size > 0.0 { return v / size; }
    return vec3f();
}

fn truncated(v: vec3f, most: f32) -> vec3f {
    let size = length(v);
    if size > most { return v * (most / size); }
    return v;
}
