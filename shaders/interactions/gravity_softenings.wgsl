// Softenings of particles: the larger one is that of a pair (as in GADGET), so that forces are equal and opposite.
struct Params { unused_word: u32, g: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> softening_length: array<f32>;

fn softening_of(me: Particle, you: Particle) -> f32 { return max(softening_length[me.index], softening_length[you.index]); }
