//! Surface tension: cohesion, curvature, and adhesion to walls (Akinci, Akinci & Teschner 2013).

use std::f64::consts::PI;

use glam::DVec3;

use super::medium::FLOWING;
use super::pressure::flow;
use super::{Boxed, FLOW, NORMAL};
use crate::kernel::{ACCELERATION, Scalar, World};
use crate::visit::{Candidate, Law, Outcome, Over, Particle};

/// The surface tension of a fluid.
///
/// γ is no σ. Cohesion goes with masses, σ = 0.003 γ ρ² h² where nothing else pulls (Kirkwood & Buff 1949), curvature with numbers of
/// neighbours; and in a drop of radius R both press as σ does on R − h, h being the support: p = 2 σ / (R − h). So measured in space,
/// for ρ = 1000 and drops of 6 to 13 spacings d, σ is γ d² times 25 000, 55 000 and 75 000 where the support is of 2, 2.5 and 3
/// spacings, to 10 %; a drop of 9 spacings swings (Rayleigh 1879) by 61 000 where that is 55 000. A quarter of γ had a fifth less than
/// a quarter of σ when drops seemed to be at rest. At other densities σ goes neither with ρ² nor with ρ: at 100 cohesion is weak.
/// Besides, cohesion presses on a fluid wherever it is, by 0.025 γ ρ² h, which changes no flow but makes it that much denser.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tension {
    /// γ, of the fluid to itself: the paper's number.
    pub tension: f64,
    /// β, of walls to the fluid.
    pub adhesion: f64,
}

/// The data of a neighbour with the normal of its surface.
const BENT: Candidate = Candidate {
    particle: crate::shader!("sph/bent.wgsl"),
    broadcast: crate::shader!("sph/bent_broadcast.wgsl"),
    listed: Some(crate::shader!("sph/bent_listed.wgsl")),
};

/// The laws that add what it does; it holds no potential energy, for curvature has none.
#[must_use]
pub fn tension(of: &Boxed, over: Over, tension: Tension) -> [Law; 2] {
    [normals(of, over), pull(of, over, tension)]
}

fn normals(of: &Boxed, over: Over) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/normal.wgsl"));
    Law::outlined("fluid normals", over, wgsl, &[NORMAL], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, FLOWING, &[FLOW, NORMAL], problem)?;
        let smoothed = medium.smoothed();
        let gather = move |_: &Particle, you: &Particle, r, _: &World, sum: &mut DVec3| {
            let density = flow(you).x;
            if density > 0.0 {
                *sum -= you.mass / density * smoothed.gradient(r) * medium.range() * r;
            }
        };
        let finish = |me: &Particle, sum: &DVec3, _: &World, outcome: &mut Outcome| {
            if flow(me).x > 0.0 {
                outcome.set(NORMAL, *sum);
            }
        };
        Ok(law.searched(search, Vec::new(), gather, finish))
    })
}

fn pull(of: &Boxed, over: Over, tension: Tension) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/tension.wgsl"));
    Law::outlined("fluid tension", over, wgsl, &[ACCELERATION.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, BENT, &[FLOW, NORMAL], problem)?;
        let volume = medium.range().powi(if medium.dimensions == 2 { 2 } else { 3 });
        let [cohesion, curvature, adhesion] =
            [32.0 / PI * tension.tension / volume, tension.tension, 0.007 * tension.adhesion / volume];
        let params = vec![
            ("cohesion", Scalar::Float(cohesion)),
            ("curvature", Scalar::Float(curvature)),
            ("adhesion", Scalar::Float(adhesion)),
        ];
        let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut DVec3| {
            let (q, way) = (r.length() / medium.range(), r.try_normalize().unwrap_or_default());
            let [mine, yours] = [me, you].map(|one| flow(one).x);
            if yours > 0.0 {
                let share = 2.0 * medium.density / (mine + yours);
                let [normal, other] = [me, you].map(|one| one.vector(NORMAL).unwrap_or_default().truncate());
                *sum += share * (cohesion * you.mass * hump(q) * way - curvature * (normal - other));
            } else {
                *sum += adhesion * you.mass * (6.0 * q - 4.0 * q * q - 2.0).max(0.0).powf(0.25) * way;
            }
        };
        let finish = |me: &Particle, sum: &DVec3, _: &World, outcome: &mut Outcome| {
            if flow(me).x > 0.0 {
                outcome.accelerate(sum.extend(0.0));
            }
        };
        Ok(law.searched(search, params, gather, finish))
    })
}

/// π h^D C / 32, of q = r / h.
fn hump(q: f64) -> f64 {
    let hump = (1.0 - q).powi(3) * q.powi(3);
    if q <= 0.5 { 2.0 * hump - 1.0 / 64.0 } else { hump }
}
