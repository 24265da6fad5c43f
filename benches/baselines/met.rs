//! The law that counts what a target meets on its walk through a tree. `tests/engine/tree` has the same file.

use glam::{DVec3, DVec4};
use motes::forces::{Law, Over, Particle};
use motes::kernel::Source;
use motes::tree::Opening;

/// Counts what is met, whatever it weighs: far groups, and particles by themselves.
const WGSL: &str = "struct Sum { far: f32, near: f32 }
fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).far += part.far;
    (*total).near += part.near;
}
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if you.index < world.count { (*sum).near += 1.0; } else { (*sum).far += 1.0; }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.far, sum.near, 0.0, 0.0); }";

/// The law; no group that may come nearer than `core` is evaluated as one.
pub fn met(opening: Opening, core: f64) -> Law {
    let nothing = |_: &Particle, _: &Particle, _: DVec3, (): &mut ()| ();
    let over = Over::Tree { opening, core, auto: false };
    let law = Law::gathering("met", over, Source::ours("met", WGSL), Vec::new(), nothing, |_, (), _| DVec4::ZERO);
    law.of_all_images()
}
