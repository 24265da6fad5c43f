// Without links: the matrix is block diagonal.
struct Expansion { pull: vec3f, own: vec3f }

fn is_tied(i: u32) -> bool { return false; }
fn pull(me: Particle, h: f32) -> vec3f { return vec3f(); }
fn expansion(me: Particle, h: f32) -> Expansion { return Expansion(); }
