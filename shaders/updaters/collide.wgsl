// Of the others that a body touches the one that comes nearest: |r + t u| < R + R', with r from me to you at the end of a step and u = v' − v.
// Where bodies merge, t is that of the closest approach during the step, on straight paths; where they bounce, t = 0, and they approach.
// Two bodies collide if each is the other's nearest. Two that are fixed, or without mass, or one that is not active, do not touch.
// `partner` is its row plus 1, 0 if there is none so far. A part of a sum may have bodies that are yet to be looked at, from the row `first` on and
// before `last`; then `partner` is the row of the particle itself.
struct Sum { partner: u32, square: f32, first: u32, last: u32 }

@group(3) @binding(1) var<storage, read> collision_size: array<f32>; // its radius
@group(3) @binding(2) var<storage, read_write> collision_partner: array<u32>; // its row plus 1; 0: none

override MERGES: bool;

// Of two that are as near the one of the lower row counts, so that each is the other's.
fn prefer(total: ptr<function, Sum>, partner: u32, square: f32) {
    let known = *total;
    let before = square == known.square && partner < known.partner;
    let nearer = square < known.square || before;
    if partner > 0u && (known.partner == 0u || nearer) {
        (*total).partner = partner;
        (*total).square = square;
    }
}

fn look(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let u = velocity_of(you) - velocity_of(me);
    let approach = dot(r, u);
    var nearest = r;
    if MERGES && approach > 0.0 { nearest -= min(approach / dot(u, u), world.dt) * u; }
    let reach = collision_size[me.index] + collision_size[you.index];
    let square = dot(nearest, nearest);
    let heavy = me.mass > 0.0 || you.mass > 0.0;
    let free = !is_held(me.index) || !is_held(you.index);
    if reach > 0.0 && square < reach * reach && heavy && free && (MERGES || approach < 0.0) {
        prefer(sum, you.index + 1u, square);
    }
}

// In an adaptive step of no length nothing happens.
fn finish(me: Particle, sum: Sum) { collision_partner[me.index] = select(0u, sum.partner, world.dt > 0.0); }
