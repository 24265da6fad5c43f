// An obstacle at rest.
fn frame() -> Frame { return Frame(params.position, params.position, vec4f(0.0, 0.0, 0.0, 1.0), vec3f(), vec3f()); }
