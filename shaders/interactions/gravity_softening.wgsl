// One softening of all pairs.
struct Params { unused_word: u32, g: f32, softening: f32 }

@group(3) @binding(0) var<uniform> params: Params;

fn softening_of(me: Particle, you: Particle) -> f32 { return params.softening; }
