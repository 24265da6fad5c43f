//! Density, its rate and the factor α, before the pressure solves.

use glam::{DVec3, DVec4};

use super::{Dfsph, RESPONSES};
use crate::error::Error;
use crate::kernel::{Kernel, World};
use crate::sph::DENSITY;
use crate::visit::{Candidate, Law, Outcome, Particle};

/// Of 1 / α times h²: a particle with less has no neighbours to push against.
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
    let (medium, smoothed) = (of.medium, of.medium.smoothed());
    let (walls, fixed) = (of.problem.clone(), of.problem.clone());
    let volume = move |mass: f64| mass / medium.density;
    let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut Sum| {
        let (mine, yours) = (volume(me.mass), volume(you.mass));
        let slope = smoothed.gradient(r) * r;
        sum.number += yours * smoothed.kernel(r);
        sum.change += yours * (you.velocity - me.velocity).dot(slope);
        sum.gradient += yours * slope;
        if walls.is_held(you.index) {
            sum.walls += yours * slope;
        } else {
            sum.squares += mine * yours * slope.length_squared();
        }
        sum.neighbors += 1.0;
    };
    let finish = move |me: &Particle, sum: &Sum, _: &World, outcome: &mut Outcome| {
        if fixed.is_held(me.index) {
            return;
        }
        let number = sum.number + volume(me.mass) * smoothed.kernel(DVec3::ZERO);
        let inverse = (sum.gradient + sum.walls).dot(sum.gradient) + sum.squares;
        let alpha = if inverse * medium.range().powi(2) > LEAST { 1.0 / inverse } else { 0.0 };
        outcome.set(DENSITY.name, medium.density * number);
        outcome.set(RESPONSES, DVec4::new(number - 1.0, alpha, sum.change, sum.neighbors));
    };
    let (search, wgsl) = (of.searching(Candidate::MOVING, &[]), crate::shader!("sph/dfsph/response.wgsl"));
    let into = [DENSITY.name, RESPONSES];
    of.search(Law::searching("fluid response", &of.grid, search, wgsl, &into, gather, finish))
}
