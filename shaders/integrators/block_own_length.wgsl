// ε of each particle.
@group(1) @binding(6) var<storage, read> softening_length: array<f32>;

fn length_of(i: u32) -> f32 { return softening_length[i]; }
