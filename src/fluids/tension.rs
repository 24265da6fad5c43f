//! Surface tension: cohesion, curvature, and adhesion to walls (Akinci, Akinci & Teschner 2013).

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::medium::FLOWING;
use super::pressure::{by_id, flowing, states};
use super::{Medium, NORMAL};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, Problem, Scalar};
use crate::visit::{Candidate, Particle, Sweep, gathered};

/// How a surface pulls.
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

/// The kernels that add what it does; it holds no potential energy, for curvature has none.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn tension(medium: &Medium, tension: Tension, problem: &Problem) -> Result<[Kernel; 2], Error> {
    Ok([normals(medium, problem)?, pull(medium, tension, problem)?])
}

fn normals(medium: &Medium, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid(problem)?;
    let files = medium.files(&[crate::shader!("fluids/normal.wgsl")]);
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let states = states(host, &slots)?;
        let flows = |body: &Particle| states[body.index].x > 0.0;
        let normals = gathered(host, me.range(), flows, |_, you, r, sum: &mut DVec3| {
            if flows(you) {
                *sum -= you.mass / states[you.index].x * me.gradient(r) * me.range() * r;
            }
        })?;
        let mut normal = host.writing::<Vec4>(&slots.field(NORMAL).1)?;
        for (normal, id) in normal.iter_mut().zip(slots.occupants(host)?) {
            if let Some(sum) = normals[id as usize] {
                *normal = sum.extend(0.0);
            }
        }
        Ok(())
    };
    let (name, params, constants) = ("fluid normals".to_owned(), Vec::new(), medium.constants());
    let sweep = Sweep { name, candidate: FLOWING, files, params, constants, twin: Arc::new(twin), grid };
    flowing(sweep, &[NORMAL], problem)
}

fn pull(medium: &Medium, tension: Tension, problem: &Problem) -> Result<Kernel, Error> {
    let grid = medium.grid(problem)?;
    let candidate = Candidate {
        particle: crate::shader!("fluids/bent.wgsl"),
        broadcast: crate::shader!("fluids/bent_broadcast.wgsl"),
    };
    let files = medium.files(&[crate::shader!("fluids/tension.wgsl")]);
    let volume = medium.range().powi(if medium.dimensions == 2 { 2 } else { 3 });
    let [cohesion, curvature, adhesion] =
        [32.0 / PI * tension.tension / volume, tension.tension, 0.007 * tension.adhesion / volume];
    let params = vec![
        ("cohesion", Scalar::Float(cohesion)),
        ("curvature", Scalar::Float(curvature)),
        ("adhesion", Scalar::Float(adhesion)),
    ];
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let (states, normals) = (states(host, &slots)?, by_id(host, &slots, NORMAL)?);
        let flows = |body: &Particle| states[body.index].x > 0.0;
        let felt = gathered(host, me.range(), flows, |a, b, r, sum: &mut DVec3| {
            let (q, way) = (r.length() / me.range(), r.try_normalize().unwrap_or_default());
            if flows(b) {
                let share = 2.0 * me.density / (states[a.index].x + states[b.index].x);
                let bend = normals[a.index] - normals[b.index];
                *sum += share * (cohesion * b.mass * hump(q) * way - curvature * bend);
            } else {
                *sum += adhesion * b.mass * (6.0 * q - 4.0 * q * q - 2.0).max(0.0).powf(0.25) * way;
            }
        })?;
        let mut acceleration = host.write(ACCELERATION)?;
        felt.iter().zip(acceleration.iter_mut()).for_each(|(felt, a)| *a += felt.unwrap_or_default().extend(0.0));
        Ok(())
    };
    let (name, constants) = ("fluid tension".to_owned(), medium.constants());
    let sweep = Sweep { name, candidate, files, params, constants, twin: Arc::new(twin), grid };
    flowing(sweep, &[NORMAL], problem)
}

/// π h^D C / 32, of q = r / h.
fn hump(q: f64) -> f64 {
    let hump = (1.0 - q).powi(3) * q.powi(3);
    if q <= 0.5 { 2.0 * hump - 1.0 / 64.0 } else { hump }
}
