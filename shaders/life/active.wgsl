// Whether a particle is active: 0 pending, 1 active, 2 removed.
@group(1) @binding(8) var<storage, read> life: array<u32>;

fn is_active(id: u32) -> bool { return life[id] == 1u; }
