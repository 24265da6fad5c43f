// Of the others that a body touches the one that comes nearest: |r + t u| < R + R', with r from me to you at the end of a step and u = v' − v.
// Where bodies merge, t is that of the closest approach during the step, on straight paths; where they bounce, t = 0, and they approach.
// Two bodies collide if each is the other's nearest. Two that are fixed, or without mass, or one that is not active, do not touch.
struct Sum { partner: u32, square: f32 } // the partner's row plus 1; 0: none so far

@group(3) @binding(1) var<storage, read> collision_radius: array<f32>;
@group(3) @binding(2) var<storage, read_write> collision_partner: array<u32>; // its row plus 1; 0: none

override MERGES: bool;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let u = velocity_of(you) - velocity_of(me);
    let approach = dot(r, u);
    var nearest = r;
    if MERGES && approach > 0.0 { nearest -= min(approach / dot(u, u), world.dt) * u; }
    let reach = collision_radius[me.index] + collision_radius[you.index];
    let square = dot(nearest, nearest);
    let heavy = me.mass > 0.0 || you.mass > 0.0;
    let free = !is_held(me.index) || !is_held(you.index);
    if square < reach * reach && heavy && free && (MERGES || approach < 0.0) && is_active(you.index) {
        merge(sum, Sum(you.index + 1u, square));
    }
}

// Of two that are as near the one of the lower row, so that each is the other's.
fn merge(total: ptr<function, Sum>, part: Sum) {
    let known = *total;
    let first = part.square == known.square && part.partner < known.partner;
    let nearer = part.square < known.square || first;
    if part.partner > 0u && (known.partner == 0u || nearer) { *total = part; }
}

// In an adaptive step of no length nothing happens.
fn finish(me: Particle, sum: Sum) {
    collision_partner[me.index] = select(0u, sum.partner, is_active(me.index) && world.dt > 0.0);
}
