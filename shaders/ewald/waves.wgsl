// The Fourier modes of a periodic box of sides L at a position: exp(2πi k·x / L), cosine and sine.
@group(3) @binding(0) var<storage, read> wave_vector: array<vec4f>; // k; how much of it there is

override WAVES: u32 = 126u;

fn wave_at(k: vec3f, x: vec3f) -> vec2f { return circle(dot(k, x * world.frequency)); }
