//! Rigid rods.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::{Component, Problem, Properties, Stage};
use crate::error::Error;
use crate::kernel::{Bounds, Host, Kernel, POSITION, Plan, Shader, VELOCITY};
use crate::links::{Chains, Node};
use crate::settings::{Key, Settings};

/// The keys in a scene.
pub const KEYS: &[Key] = &[];

/// `rod`: the particles' rods keep their lengths (RATTLE; Andersen 1983), in chains of any shape that hang from fixed particles
/// or fly free; fixed particles are infinitely heavy to them.
///
/// It is written as two projections, so that every integrator has it. After a drift by c dt velocities change along the rods as
/// they were before it, v ← v + δ, and positions with them, x ← x + c dt δ, until no length has changed; and what is left of
/// velocities along the rods is taken away: this is a step of RATTLE for particles that no force pulls. After a kick velocities
/// along the rods are taken away alone. Kick-drift-kick of these *is* RATTLE: to project after the first kick as well changes
/// nothing, because what it takes away lies along the rods before the drift, and the drift would take the rest of it. So
/// `leapfrog` is symplectic and reversible, and its energy stays in bounds. `symplectic_euler` is its companion of order 1. All
/// other methods are held to order 2: `forest_ruth` and `pefrl`, whose drifts along curves are of that order, reversible
/// still; and the Runge–Kutta and implicit methods, which go a whole step without rods before they are brought back, and keep
/// no energy.
///
/// What rounding makes of the lengths is taken back from positions alone, in every step anew: lengths hold to about 1e-7 of the
/// larger of the length and the distance from the origin, and speeds know nothing of it. A chain that turns by about a radian
/// in one drift is not found again: its particles are then NaN, which stops the run. In a scene it stands behind the
/// forces that limit speeds or move particles out of solids, because the last word is right.
#[derive(Clone)]
pub struct Rod;

impl Rod {
    /// From checked settings.
    #[must_use]
    pub fn new(_settings: &Settings) -> Self {
        Self
    }
}

impl Component for Rod {
    fn properties(&self) -> Properties {
        let why = "rods are constrained with velocities of the previous step, which must have the same length";
        Properties { fixed_step: Some(why), keeps_rods: true, constrains: true, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::AfterKick => add(plan, problem, 0.0, false),
            Stage::AfterDrift { factor } => add(plan, problem, factor, false),
            Stage::AfterAdvance { factor } => add(plan, problem, factor, true),
            _ => Ok(()),
        }
    }
}

fn add(plan: &mut Plan, problem: &Problem, factor: f64, settles: bool) -> Result<(), Error> {
    let held: Vec<u32> = problem.held.iter().map(|held| held.id).collect();
    let chains = Chains::new(&problem.network.rods, &held)?;
    if !chains.is_empty() {
        plan.add(kernel(chains, factor, settles)?);
    }
    Ok(())
}

/// The kernel after a drift by a part of the step, or with 0 after a kick; or after a step that `settles`.
fn kernel(chains: Chains, factor: f64, settles: bool) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("constraints/rod.wgsl")])?;
    let count = u32::try_from(chains.len()).unwrap_or(u32::MAX);
    let nodes = chains.0.iter().map(|chain| chain.len() as u64).sum();
    let tables = vec![
        ("chain_start".into(), Arc::new(chains.starts())),
        ("chain_node".into(), Arc::new(chains.words())),
    ];
    let sizes = vec![
        ("chain_start".into(), u64::from(count) + 1),
        ("chain_node".into(), nodes),
        ("chain_sweep".into(), nodes),
    ];
    let reference = move |host: &Host| {
        let (world, mut position, mut velocity) = (host.world(), host.write(POSITION)?, host.write(VELOCITY)?);
        let h = factor * world.dt;
        let right = |chain: &Vec<Node>| {
            let mut chain = Chain {
                x: chain.iter().map(|node| position[node.id as usize].truncate()).collect(),
                v: chain.iter().map(|node| velocity[node.id as usize].truncate()).collect(),
                w: chain.iter().map(|node| if node.held { 0.0 } else { 1.0 / position[node.id as usize].w }).collect(),
                length: chain[1..].iter().map(|node| node.length).collect(),
                bounds: world.bounds,
            };
            chain.rattle(h, settles);
            chain
        };
        let all: Vec<Chain> = chains.0.par_iter().map(right).collect();
        for (nodes, chain) in chains.0.iter().zip(all) {
            for ((node, x), v) in nodes.iter().zip(chain.x).zip(chain.v).filter(|((node, _), _)| !node.held) {
                let id = node.id as usize;
                position[id] = x.extend(position[id].w);
                velocity[id] = v.extend(velocity[id].w);
            }
        }
        Ok(())
    };
    let constants = vec![("FACTOR", factor), ("CHAINS", f64::from(count)), ("SETTLES", f64::from(u8::from(settles)))];
    let mut kernel = Kernel::new("rod", shader, constants, count, Arc::new(reference));
    for pass in &mut kernel.passes {
        // Each particle of a chain is accessed about as often as in this many pair evaluations.
        pass.work = 16 * nodes;
    }
    Ok(Kernel { sizes, tables, scratch: vec!["chain_sweep".into()], ..kernel })
}

/// A chain as the reference has it: rod n leads from particle n to particle n + 1.
struct Chain {
    x: Vec<DVec3>,
    v: Vec<DVec3>,
    w: Vec<f64>,
    length: Vec<f64>,
    bounds: Bounds,
}

impl Chain {
    fn ways(&self) -> Vec<DVec3> {
        self.x.windows(2).map(|x| self.bounds.shortest(x[1] - x[0])).collect()
    }
    /// The whole of it, after a drift by h.
    fn rattle(&mut self, h: f64, settles: bool) {
        if h != 0.0 {
            let growth: Vec<DVec3> = self.v.windows(2).map(|v| v[1] - v[0]).collect();
            let old: Vec<DVec3> = self.ways().iter().zip(growth).map(|(r, v)| *r - h * v).collect();
            let lengths = if settles { self.length.clone() } else { old.iter().map(|r| r.length()).collect() };
            let changes = self.reach(Some(&old), &lengths);
            self.v.iter_mut().zip(changes).for_each(|(v, change)| *v += change / h);
            self.reach(None, &self.length.clone());
        }
        let ways = self.ways();
        let growth = ways.iter().zip(self.v.windows(2)).map(|(r, v)| -r.dot(v[1] - v[0])).collect();
        let lambda = self.solve(&ways, &ways, growth);
        for (v, change) in self.v.iter_mut().zip(changes(&self.w, &ways, &lambda)) {
            *v += change;
        }
    }
    /// Moves particles until the rods have these lengths, along fixed directions or always along the present rods, and returns the changes.
    fn reach(&mut self, fixed: Option<&[DVec3]>, lengths: &[f64]) -> Vec<DVec3> {
        let mut moved = vec![DVec3::ZERO; self.x.len()];
        let mut worst = f64::INFINITY;
        for _ in 0..50 {
            let ways = self.ways();
            let misses: Vec<f64> = ways.iter().zip(lengths).map(|(r, l)| 0.5 * (l * l - r.length_squared())).collect();
            let parts = misses.iter().zip(lengths).map(|(miss, l)| miss.abs() / (l * l));
            let before = std::mem::replace(&mut worst, parts.fold(0.0, f64::max));
            // Until it is exact, or rounding takes as much as is gained.
            if worst == 0.0 || worst < 1e-9 && worst >= before {
                break;
            }
            let along = fixed.unwrap_or(&ways);
            let lambda = self.solve(&ways, along, misses);
            for (n, change) in changes(&self.w, along, &lambda).into_iter().enumerate() {
                self.x[n] += change;
                moved[n] += change;
            }
        }
        if worst.is_nan() || worst > 1e-9 {
            self.x.fill(DVec3::NAN);
        }
        moved
    }
    /// Solves R W Gᵀ λ = b, which ties a rod to the two beside it, by rotations (Givens 1958).
    fn solve(&self, ways: &[DVec3], along: &[DVec3], mut b: Vec<f64>) -> Vec<f64> {
        let last = ways.len() - 1;
        // The effect of a rod on another, through the particle that they share.
        let shared = |n: usize, m: usize| -self.w[n.max(m)] * ways[n].dot(along[m]);
        let mut rows: Vec<[f64; 3]> = (0..=last)
            .map(|n| {
                let own = (self.w[n] + self.w[n + 1]) * ways[n].dot(along[n]);
                [own, if n < last { shared(n, n + 1) } else { 0.0 }, 0.0]
            })
            .collect();
        for n in 0..last {
            let (top, next, below) = (rows[n], rows[n + 1], shared(n + 1, n));
            let size = top[0].hypot(below);
            let (cos, sin) = (top[0] / size, below / size);
            rows[n] = [size, cos * top[1] + sin * next[0], sin * next[1]];
            rows[n + 1] = [cos * next[0] - sin * top[1], cos * next[1], 0.0];
            (b[n], b[n + 1]) = (cos * b[n] + sin * b[n + 1], cos * b[n + 1] - sin * b[n]);
        }
        for n in (0..=last).rev() {
            let known = |k: usize| b.get(n + k).map_or(0.0, |x| rows[n][k] * x);
            b[n] = (b[n] - known(1) - known(2)) / rows[n][0];
        }
        b
    }
}

/// W Gᵀ λ: what the forces along the rods change.
fn changes(w: &[f64], along: &[DVec3], lambda: &[f64]) -> Vec<DVec3> {
    let mut changes = vec![DVec3::ZERO; w.len()];
    for (n, (r, lambda)) in along.iter().zip(lambda).enumerate() {
        changes[n] -= w[n] * *lambda * *r;
        changes[n + 1] += w[n + 1] * *lambda * *r;
    }
    changes
}
