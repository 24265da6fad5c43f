// Some are yet to be born, and some are dead: 0 waits, 1 lives, 2 is dead.
@group(1) @binding(8) var<storage, read> life: array<u32>;

fn lives(id: u32) -> bool { return life[id] == 1u; }
