// Whether a particle is fixed, in a simulation with fixed particles.
@group(1) @binding(10) var<storage, read> held: array<u32>;

fn is_held(id: u32) -> bool { return held[id] != 0u; }
