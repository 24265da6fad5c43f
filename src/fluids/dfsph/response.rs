//! What is known of the fluid before pressure is solved for.

use std::sync::Arc;

use glam::DVec3;

use super::{Dfsph, RESPONSE, RESPONSES};
use crate::error::Error;
use crate::fluids::DENSITY;
use crate::kernel::{Host, Kernel};
use crate::visit::{Candidate, gathered};

/// Of 1 / α times h²: who has less has nobody to push against.
const LEAST: f64 = 1e-6;

#[derive(Default)]
struct Sum {
    number: f64,
    change: f64,
    gradient: DVec3,
    walls: DVec3,
    squares: f64,
    neighbors: f64,
}

/// The kernel: density, α, how fast the density grows, and how many are in range.
pub fn kernel(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let (holding, tables) = of.problem.holding();
    let (medium, who, slots, responses) = (of.medium, of.problem.clone(), of.slots(), of.name(RESPONSES));
    let twin = move |host: &Host| {
        let volume = |mass: f64| mass / medium.density;
        let sums = gathered(
            host,
            medium.range(),
            |me| !who.is_held(me.index),
            |me, you, r, sum: &mut Sum| {
                let (mine, yours) = (volume(me.mass), volume(you.mass));
                let slope = medium.gradient(r) * r;
                sum.number += yours * medium.kernel(r);
                sum.change += yours * (you.velocity - me.velocity).dot(slope);
                sum.gradient += yours * slope;
                if who.is_held(you.index) {
                    sum.walls += yours * slope;
                } else {
                    sum.squares += mine * yours * slope.length_squared();
                }
                sum.neighbors += 1.0;
            },
        )?;
        let view = crate::visit::View::of(host)?;
        let bodies = view.particles();
        let (mut density, mut responses) = (host.write(DENSITY)?, host.writing::<f32>(&responses)?);
        for (k, id) in slots(host)?.into_iter().enumerate() {
            let (Some(sum), Some(me)) = (&sums[id], bodies.get(id)) else { continue };
            let number = sum.number + volume(me.mass) * medium.kernel(DVec3::ZERO);
            let inverse = (sum.gradient + sum.walls).dot(sum.gradient) + sum.squares;
            let alpha = if inverse * medium.range().powi(2) > LEAST { 1.0 / inverse } else { 0.0 };
            density[id] = medium.density * number;
            let response = [number - 1.0, alpha, sum.change, sum.neighbors];
            responses[RESPONSE * k..RESPONSE * (k + 1)].copy_from_slice(&response);
        }
        Ok(())
    };
    let files = vec![holding, crate::shader!("fluids/dfsph/response.wgsl")];
    let kernel = of.search("fluid response", Candidate::MOVING, files, Arc::new(twin))?;
    Ok(Kernel { tables, ..kernel })
}
