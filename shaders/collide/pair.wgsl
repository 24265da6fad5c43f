// The row of the body with which one collides: each is the other's nearest.
@group(3) @binding(2) var<storage, read> collision_partner: array<u32>; // the row plus 1; 0: none

const NONE: u32 = 0xffffffffu;

fn collided(i: u32) -> u32 {
    let partner = collision_partner[i];
    if partner > 0u && collision_partner[partner - 1u] == i + 1u { return partner - 1u; }
    return NONE;
}
