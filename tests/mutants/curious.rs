//! Laws that look at all that a search passes to them, and vanish at no edge.

use glam::{DVec3, DVec4};
use motes::forces::{Law, Over, Particle};
use motes::kernel::{Source, World};

/// The species that is not put into a filtered grid.
pub const OTHERS: u32 = 1;

/// A law that looks at everything that a visit passes to it, and vanishes at no edge.
pub const MOVING: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let v = velocity_of(you) - velocity_of(me);
    let near = 1.0 / (1.0 + dot(r, r));
    (*sum).acceleration += (you.mass * near) * (v + f32(you.index % 7u) * r);
    (*sum).potential += you.mass * me.mass * near;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
/// One that asks for no velocities, and leaves some out.
pub const STILL: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let near = you.mass / (1.0 + dot(r, r));
    (*sum).acceleration += near * f32(you.index % 7u + 1u) * r;
    (*sum).potential += me.mass * near;
}
fn acts_on(me: Particle) -> bool { return me.index % 5u != 2u; }
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
/// One that does not leave anybody out.
pub const TOUCHING: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let near = you.mass / (1.0 + dot(r, r));
    (*sum).acceleration += near * f32(you.index % 7u + 1u) * r;
    (*sum).potential += me.mass * near;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
/// One that acts on one species, by its own declaration.
pub const CHOOSY: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if species[you.index] == 2u {
        let near = you.mass / (1.0 + dot(r, r));
        (*sum).acceleration += near * f32(you.index % 7u + 1u) * r;
        (*sum).potential += me.mass * near;
    }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";

/// The law of such a text.
pub fn law(text: &'static str, over: Over) -> Law {
    let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec4| {
        let near = you.mass / (1.0 + r.length_squared());
        let weight = (you.index % 7) as f64;
        let met = text != CHOOSY || you.species() == OTHERS + 1;
        let part = if text == MOVING { you.velocity - me.velocity + weight * r } else { (weight + 1.0) * r };
        *sum += f64::from(u8::from(met)) * (near * part).extend(me.mass * near);
    };
    let finish = move |me: &Particle, sum: &DVec4, _: &World| {
        if text == STILL && me.index % 5 == 2 { DVec4::ZERO } else { *sum }
    };
    Law::gathering("curious", over, Source::ours("curious", text), Vec::new(), gather, finish)
}
